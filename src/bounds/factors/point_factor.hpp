// Bounds of the form factor from each point of a polygon to another that nothing hides.
#pragma once

#include "bounds/factors/pair_geometry.hpp"

namespace enfilade {

/// The form factor from each point x of the receiver, as an affine function of the place:
/// |F(x) - (center + gradient . (x - receiver.center))| <= remainder.
struct PointFactor {
  double center = 0.0;
  Vec3 gradient{0.0};
  double remainder = 0.0;
  Range range(double radius_m) const {
    const double reach = remainder + glm::length(gradient) * radius_m;
    return {center - reach, center + reach};
  }
};

/// Bounds of the form factor from each point of the receiver to a shooter, both in front of each
/// other: the closed form and its gradient at the receiver's centre and a bound of the second
/// derivatives, or what kernel_range allows, whichever is narrower. Up to 2^parts parts of the
/// receiver tell how far the affine function is off, where its own remainder is large.
PointFactor open_point_factor(const FlatShape& receiver, const FlatShape& shooter, int parts);

/// Standard deviation over a shape of all functions that an affine description allows, at most.
double deviation_of_affine(const PointFactor& f, const FlatShape& shape);

/// Standard deviation of the kernel over the shooter, seen from any one point of the receiver, over
/// its mean, at most: from the ratio of its largest to its least value.
double point_deviation(const FlatShape& receiver, const FlatShape& shooter);

/// Standard deviation over the shooter of the difference between the kernel at any point of the
/// receiver and its mean over the receiver, times the shooter's area, at most. The difference's
/// gradient along the shooter is at most the mixed second derivative of K times the distance to the
/// mean's points, and |d/dx d/dy r^-4| <= 28 r^-6, |d/dx r^-4| <= 4 r^-5.
double kernel_shift(const FlatShape& receiver, const FlatShape& shooter);

/// Bounds of the form factor from each point of the receiver that hold for all points: without a
/// gradient. Shooters that are close for their size are cut up to `depth` times.
Range open_point_range(const FlatShape& receiver, const FlatShape& shooter, int depth);

}  // namespace enfilade
