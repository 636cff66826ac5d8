// Planar convex polygons, planes and segments: measures, distances, point in polygon.
#pragma once

#include <span>
#include <vector>

#include "base/geometry.hpp"

namespace enfilade {

/// Corners in metres, counter-clockwise seen from the front (reflecting) side.
using Polygon = std::vector<Vec3>;

/// A plane n.p = d, n of unit length; the front is where n.p > d.
struct Plane {
  Vec3 n{0.0, 0.0, 1.0};
  double d = 0.0;
  double signed_distance(const Vec3& p) const { return glm::dot(n, p) - d; }
  Plane flipped() const { return {-n, -d}; }
};

struct Segment {
  Vec3 a{0.0}, b{0.0};
  double length_m() const { return glm::length(b - a); }
};

/// Twice the area times the unit normal, robust for any planar polygon.
inline Vec3 area_vector(std::span<const Vec3> polygon) {
  Vec3 sum(0.0);
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    sum += glm::cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  }
  return sum;
}
double area_m2(std::span<const Vec3> polygon);
double total_area_m2(std::span<const Polygon> polygons);
/// Returns the unit normal; zero for a degenerate polygon.
Vec3 normal(const Polygon& polygon);
/// Returns the area centroid.
Vec3 centroid(const Polygon& polygon);
Plane plane_of(const Polygon& polygon);
Box bounds(const Polygon& polygon);

/// Returns the outward planes through the edges of a polygon with unit normal `n`, at right angles
/// to it; edges of at most `shortest_m` metres have none.
std::vector<Plane> edge_planes(const Polygon& polygon, const Vec3& n, double shortest_m);

/// True where p, a point of the polygon's plane, lies inside the convex polygon with normal `n` (of
/// any length). Its edges count as inside; no tolerance.
bool contains(const Polygon& polygon, const Vec3& n, const Vec3& p);
/// True where p lies inside the polygon enlarged by `reach_m` on all sides; `n` is of unit length.
/// Rounds otherwise than `contains`: (n x edge) . (p - corner) here, (edge x (p - corner)) . n
/// there.
bool contains_within(const Polygon& polygon, const Vec3& n, const Vec3& p, double reach_m);
/// True where p lies inside the convex polygon of the plane, its corners counter-clockwise. Its
/// edges count as inside; no tolerance.
bool contains(std::span<const Vec2> polygon, const Vec2& p);

/// How far points lie from a plane, metres.
struct DistanceRange {
  double lowest = 0.0;   ///< of the point farthest behind the plane; 0 where none is behind it
  double highest = 0.0;  ///< of the point farthest in front; 0 where none is in front
  double sum = 0.0;
  void add(double signed_distance);
};
DistanceRange distances(std::span<const Vec3> points, const Plane& plane);
/// True where all points lie in the plane, to within `tolerance_m`.
bool lies_in(std::span<const Vec3> points, const Plane& plane, double tolerance_m);
/// Returns the largest signed distance of a point of the box.
double highest_distance(const Box& box, const Plane& plane);

}  // namespace enfilade
