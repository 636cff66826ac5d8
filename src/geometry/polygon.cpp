// Areas, planes and cuts of polygons, computed relative to a vertex so that a far origin costs no
// digits.
#include "geometry/polygon.hpp"

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

// Planes through the edges of b, at right angles to it, looking outward.
std::vector<Plane> edge_planes(const Polygon& b) {
  std::vector<Plane> planes;
  const Vec3 n = normal(b);
  const double shortest = 1e-12 * bounds(b).diagonal();
  for (std::size_t i = 0; i < b.size(); ++i) {
    const Vec3& p = b[i];
    const Vec3 edge = b[(i + 1) % b.size()] - p;
    const Vec3 out = glm::cross(edge, n);
    const double length = glm::length(out);
    if (length <= shortest) continue;
    planes.push_back({out / length, glm::dot(out / length, p)});
  }
  return planes;
}

}  // namespace

Vec3 area_vector(const Polygon& polygon) {
  Vec3 sum(0.0);
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    sum += glm::cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  }
  return sum;
}

double area_m2(const Polygon& polygon) { return 0.5 * glm::length(area_vector(polygon)); }

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

std::pair<Polygon, Polygon> split(const Polygon& polygon, const Plane& plane, double tolerance) {
  const std::size_t count = polygon.size();
  std::vector<double> distance(count);
  bool any_front = false, any_behind = false;
  for (std::size_t i = 0; i < count; ++i) {
    distance[i] = plane.signed_distance(polygon[i]);
    if (std::abs(distance[i]) <= tolerance) distance[i] = 0.0;
    any_front |= distance[i] > 0.0;
    any_behind |= distance[i] < 0.0;
  }
  if (!any_behind) return {polygon, {}};
  if (!any_front) return {{}, polygon};
  Polygon front, behind;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t j = (i + 1) % count;
    if (distance[i] >= 0.0) front.push_back(polygon[i]);
    if (distance[i] <= 0.0) behind.push_back(polygon[i]);
    if (distance[i] * distance[j] >= 0.0) continue;
    // From the front end always, so that two polygons that share the edge get the very same point.
    const std::size_t f = distance[i] > 0.0 ? i : j, b = f == i ? j : i;
    const double t = distance[f] / (distance[f] - distance[b]);
    const Vec3 crossing = polygon[f] + t * (polygon[b] - polygon[f]);
    front.push_back(crossing);
    behind.push_back(crossing);
  }
  return {std::move(front), std::move(behind)};
}

std::vector<Polygon> subtract_coplanar(const Polygon& a, const Polygon& b, double tolerance) {
  std::vector<Polygon> left;
  Polygon inside = a;
  const std::vector<Plane> planes = edge_planes(b);
  if (planes.size() < 3) return {a};
  for (const Plane& plane : planes) {
    // An edge of `a` that lies in the plane up to tolerance must stay inside: only what sticks out
    // is cut.
    auto [outside, rest] = split(inside, plane, tolerance);
    if (rest.empty()) return {a};
    if (!outside.empty()) left.push_back(std::move(outside));
    inside = std::move(rest);
  }
  return left;
}

Polygon intersect_coplanar(const Polygon& a, const Polygon& b, double tolerance) {
  Polygon inside = a;
  const std::vector<Plane> planes = edge_planes(b);
  if (planes.size() < 3) return {};
  for (const Plane& plane : planes) {
    inside = split(inside, plane, tolerance).second;
    if (inside.empty()) break;
  }
  return inside;
}

}  // namespace enfilade
