// Areas, planes and distances of polygons; areas are computed relative to a vertex so that a far
// origin costs no digits.
#include "geometry/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace enfilade {
namespace {

// A polygon whose area vector is below what rounding of its own coordinates can produce has no
// normal.
double area_noise(const Polygon& polygon) {
  constexpr double eps = std::numeric_limits<double>::epsilon();
  const Box box = bounds(polygon);
  if (box.empty()) return 0.0;
  const double extent = box.diagonal();
  const double farthest = std::max(glm::length(box.lo), glm::length(box.hi));
  return extent * (1e-12 * extent + 8.0 * eps * farthest);
}

}  // namespace

double area_m2(std::span<const Vec3> polygon) { return 0.5 * glm::length(area_vector(polygon)); }

double total_area_m2(std::span<const Polygon> polygons) {
  double sum = 0.0;
  for (const Polygon& polygon : polygons) sum += area_m2(polygon);
  return sum;
}

Vec3 normal(const Polygon& polygon) {
  const Vec3 v = area_vector(polygon);
  const double length = glm::length(v);
  return length > area_noise(polygon) ? v / length : Vec3(0.0);
}

Vec3 centroid(const Polygon& polygon) {
  if (polygon.empty()) return Vec3(0.0);
  const Vec3 n = normal(polygon);
  const Vec3& origin = polygon[0];
  Vec3 weighted(0.0), mean(0.0);
  double total = 0.0;
  for (std::size_t i = 1; i < polygon.size(); ++i) mean += polygon[i] - origin;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const Vec3 a = polygon[i - 1] - origin, b = polygon[i] - origin;
    const double w = glm::dot(n, glm::cross(a, b));
    weighted += w * (a + b) / 3.0;
    total += w;
  }
  if (total <= 0.0) return origin + mean / static_cast<double>(polygon.size());
  return origin + weighted / total;
}

Plane plane_of(const Polygon& polygon) {
  Plane plane{normal(polygon), 0.0};
  if (polygon.empty()) return plane;
  // The mean over the vertices halves the worst distance of a polygon that is not quite planar.
  double mean = 0.0;
  for (const Vec3& p : polygon) mean += glm::dot(plane.n, p - polygon[0]);
  plane.d = glm::dot(plane.n, polygon[0]) + mean / static_cast<double>(polygon.size());
  return plane;
}

Box bounds(const Polygon& polygon) {
  Box box;
  for (const Vec3& p : polygon) box.add(p);
  return box;
}

std::vector<Plane> edge_planes(const Polygon& polygon, const Vec3& n, double shortest_m) {
  std::vector<Plane> planes;
  planes.reserve(polygon.size());
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3& p = polygon[i];
    const Vec3 edge = polygon[(i + 1) % polygon.size()] - p;
    const Vec3 out = glm::cross(edge, n);
    const double length = glm::length(out);
    if (length <= shortest_m) continue;
    planes.push_back({out / length, glm::dot(out / length, p)});
  }
  return planes;
}

namespace {

/// contains() by binary search: of the triangles from the first corner to each edge, the one on
/// whose side the point lies is the only one that can hold it.
bool contains_by_halves(const Polygon& polygon, const Vec3& n, const Vec3& p) {
  const auto left_of = [&](std::size_t i, std::size_t j) {
    return glm::dot(glm::cross(polygon[j] - polygon[i], p - polygon[i]), n) >= 0.0;
  };
  std::size_t low = 1, high = polygon.size() - 1;
  if (!left_of(0, low) || !left_of(high, 0)) return false;
  while (high - low > 1) {
    const std::size_t middle = low + (high - low) / 2;
    (left_of(0, middle) ? low : high) = middle;
  }
  return left_of(low, high);
}

}  // namespace

bool contains(const Polygon& polygon, const Vec3& n, const Vec3& p) {
  constexpr std::size_t few_corners = 32;
  if (polygon.size() > few_corners) return contains_by_halves(polygon, n, p);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    if (glm::dot(glm::cross(b - a, p - a), n) < 0.0) return false;
  }
  return true;
}

bool contains_within(const Polygon& polygon, const Vec3& n, const Vec3& p, double reach_m) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    const double limit = reach_m > 0.0 ? reach_m * glm::length(edge) : 0.0;
    if (glm::dot(glm::cross(n, edge), p - polygon[i]) < -limit) return false;
  }
  return true;
}

bool contains(std::span<const Vec2> polygon, const Vec2& p) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    if (cross2(b - a, p - a) < 0.0) return false;
  }
  return true;
}

void DistanceRange::add(double signed_distance) {
  lowest = std::min(lowest, signed_distance);
  highest = std::max(highest, signed_distance);
  sum += signed_distance;
}

DistanceRange distances(std::span<const Vec3> points, const Plane& plane) {
  DistanceRange range;
  for (const Vec3& p : points) range.add(plane.signed_distance(p));
  return range;
}

bool lies_in(std::span<const Vec3> points, const Plane& plane, double tolerance_m) {
  return std::all_of(points.begin(), points.end(), [&](const Vec3& p) {
    return std::abs(plane.signed_distance(p)) <= tolerance_m;
  });
}

double highest_distance(const Box& box, const Plane& plane) {
  const Vec3 half = 0.5 * box.extent();
  return plane.signed_distance(box.center()) + glm::dot(glm::abs(plane.n), half);
}

}  // namespace enfilade
