// Bounds of the light that two polygons exchange where nothing stands between them.
#pragma once

#include "bounds/flat_shape.hpp"

namespace enfilade {

/// An interval.
struct Range {
  double lo = 0.0, hi = 0.0;
  double width() const { return hi - lo; }
};

/// Returns a lower bound of the distance between two convex polygons, m: the largest gap that the
/// frames of both planes and the line between the centres show; 0 where they touch.
double least_distance(const FlatShape& a, const FlatShape& b);
/// Returns the largest distance of a point of one from a point of the other, m.
double largest_distance(const FlatShape& a, const FlatShape& b);

/// The largest part of a hemisphere about `n` that can be filled by fronts with the normal `m`:
/// both hemispheres' common lune, (1 - n.m) / 2.
double most_by_facing(const Vec3& n, const Vec3& m);

/// Bounds of the kernel K = cos cos' / (pi r^2), 1/m2, for all pairs of points of two shapes that
/// lie in front of each other. With a(y) the height of y above the receiver's plane and b(x) that
/// of x above the shooter's, K = a(y) b(x) / (pi r^4): a depends on y alone, b on x alone, both
/// affine, so that their extremes lie at corners.
Range kernel_range(const FlatShape& receiver, const FlatShape& shooter);

/// Bounds of the integral of K over both shapes, m2: area of either times its mean form factor to
/// the other. Both must lie in front of each other. K is a product of affine functions and r^-4,
/// which polynomials of r^2 bound from below and above (inverse_power.hpp); their integrals are
/// exact sums. Pairs that are close for their size are cut until the bounds differ by at most
/// `tolerance_m2` for each part, or `depth` times.
Range open_flux(const FlatShape& receiver, const FlatShape& shooter, double tolerance_m2,
                int depth);

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
