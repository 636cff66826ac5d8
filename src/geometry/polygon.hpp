// Planar convex polygons: the one shape that every room works on.
#pragma once

#include <utility>
#include <vector>

#include "base/geometry.hpp"

namespace enfilade {

/// Vertices in metres, counter-clockwise seen from the front (reflecting) side.
using Polygon = std::vector<Vec3>;

/// A plane n.p = d, n of unit length; the front is where n.p > d.
struct Plane {
  Vec3 n{0.0, 0.0, 1.0};
  double d = 0.0;
  double signed_distance(const Vec3& p) const { return glm::dot(n, p) - d; }
};

struct Segment {
  Vec3 a{0.0}, b{0.0};
  double length_m() const { return glm::length(b - a); }
};

/// Twice the area times the unit normal (Newell), robust for any planar polygon.
Vec3 area_vector(const Polygon& polygon);
double area_m2(const Polygon& polygon);
/// Unit normal; zero for a degenerate polygon.
Vec3 normal(const Polygon& polygon);
/// Area centroid.
Vec3 centroid(const Polygon& polygon);
Plane plane_of(const Polygon& polygon);
Box bounds(const Polygon& polygon);

/// Cuts by a plane: first = the part in front, second = the part behind; either may be empty.
/// Vertices within `tolerance` metres of the plane count as on it, so no sliver thinner than that
/// is made. A polygon that lies in the plane counts as in front.
std::pair<Polygon, Polygon> split(const Polygon& polygon, const Plane& plane, double tolerance);

/// a minus b, both convex and coplanar within tolerance: at most |b| convex pieces, none for full
/// cover, {a} itself where they do not overlap by more than `tolerance`. The two may face opposite
/// ways.
std::vector<Polygon> subtract_coplanar(const Polygon& a, const Polygon& b, double tolerance);

/// The common part of two convex coplanar polygons, facing as `a` does; empty where there is none.
Polygon intersect_coplanar(const Polygon& a, const Polygon& b, double tolerance);

}  // namespace enfilade
