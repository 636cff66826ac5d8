// Point-to-polygon form factors in closed form.
#pragma once

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

}  // namespace enfilade
