// Point-to-polygon form factors in closed form.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "base/geometry.hpp"

namespace enfilade {

/// Returns the form factor from a differential area at x with unit normal n to a planar convex
/// polygon (front side counter-clockwise): the share of x's cosine-weighted hemisphere that the
/// polygon fills; dimensionless, in [0, 1]. The part below x's horizon does not count; zero where x
/// is behind the polygon. Lambert's formula: F = 1/(2 pi) sum over edges of (angle of the edge seen
/// from x) * (unit normal of the triangle x, edge) . n.
double point_to_polygon(const Vec3& x, const Vec3& n, std::span<const Vec3> polygon);

/// Returns the solid angle (sr) of a planar convex polygon seen from x, from either side (Van
/// Oosterom and Strackee 1983).
double solid_angle(const Vec3& x, std::span<const Vec3> polygon);

/// Returns the point-to-point kernel cos cos' / (pi r^2), 1/m2; zero where either faces away.
double point_kernel(const Vec3& x, const Vec3& n, const Vec3& y, const Vec3& m);

/// A convex receiver: its corners, unit normal, centre and the radius of a ball about it, metres.
struct FlatReceiver {
  std::span<const Vec3> corners;
  Vec3 n{0.0}, center{0.0};
  double radius_m = 0.0;
};

struct RimConfig {
  double gap = 0.25;  ///< polygons are close below this distance, in radii of the receiver
  /// The rim is looked at where the inner points' factors differ by less than this share: else
  /// their fit shows what varies.
  double spread = 0.3;
  /// Area of the rim per gap in radii: a strip as wide as the gap along the sides of a square, on
  /// which half of what the corners lose is lost; at most the share of a corner's quarter.
  double area_per_gap = 2.0, most_area = 0.25;
};

/// Two polygons may almost touch, as a drawer and its shelf: the shooter fills the hemispheres of
/// all inner points of the receiver and leaves those along its rim half empty. Returns the mean
/// misfit over the receiver of a constant through the inner points' factors `at`; 0 where the
/// polygons are not close. Adds the number of factors that it evaluates to `evaluated`.
double rim_misfit(const FlatReceiver& receiver, std::span<const Vec3> shooter,
                  const std::array<double, 4>& at, std::uint64_t& evaluated,
                  const RimConfig& config = {});

}  // namespace enfilade
