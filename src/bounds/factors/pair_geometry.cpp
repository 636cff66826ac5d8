#include "bounds/factors/pair_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace enfilade {
namespace {

using std::numbers::pi;

double gap_along(const FlatShape& a, const FlatShape& b, const Vec3& axis) {
  Range of_a{1e300, -1e300}, of_b{1e300, -1e300};
  for (const auto& [shape, range] : {std::pair{&a, &of_a}, std::pair{&b, &of_b}}) {
    for (const Vec3& p : shape->polygon) {
      const double x = glm::dot(axis, p);
      range->lo = std::min(range->lo, x);
      range->hi = std::max(range->hi, x);
    }
  }
  return std::max({0.0, of_a.lo - of_b.hi, of_b.lo - of_a.hi});
}

double gap_in_frame(const FlatShape& a, const FlatShape& b, const Vec3& n, const Vec3& edge) {
  const double length = glm::length(edge);
  if (length <= 0.0) return 0.0;
  const Vec3 u = edge / length, v = glm::cross(n, u);
  return glm::length(Vec3(gap_along(a, b, n), gap_along(a, b, u), gap_along(a, b, v)));
}

}  // namespace

Range heights(const FlatShape& shape, const Plane& plane) {
  Range range{1e300, 0.0};
  for (const Vec3& p : shape.polygon) {
    const double height = plane.signed_distance(p);
    range.lo = std::min(range.lo, height);
    range.hi = std::max(range.hi, height);
  }
  return {std::max(0.0, range.lo), range.hi};
}

double spread(const Range& s) { return s.hi > 0.0 ? (s.hi - s.lo) / (s.hi + s.lo) : 1.0; }

Range squared_distances(const FlatShape& a, const FlatShape& b) {
  const double least = least_distance(a, b), most = largest_distance(a, b);
  return {least * least, std::max(least * least, most * most)};
}

Range kernel_range(const FlatShape& receiver, const FlatShape& shooter, const Range& s) {
  const Range a = heights(shooter, receiver.plane), b = heights(receiver, shooter.plane);
  Range k;
  k.lo = s.hi > 0.0 ? a.lo * b.lo / (pi * s.hi * s.hi) : 0.0;
  k.hi = s.lo > 0.0 ? std::min(a.hi * b.hi / (s.lo * s.lo), 1.0 / s.lo) / pi : 1e300;
  return k;
}

Range kernel_range(const FlatShape& receiver, const FlatShape& shooter) {
  return kernel_range(receiver, shooter, squared_distances(receiver, shooter));
}

double least_distance(const FlatShape& a, const FlatShape& b) {
  double least = 0.0;
  const Vec3 between = b.center - a.center;
  if (const double length = glm::length(between); length > 0.0)
    least = std::max(least, gap_along(a, b, between / length));
  for (const FlatShape* shape : {&a, &b}) {
    if (shape->polygon.size() < 2) continue;
    least =
        std::max(least, gap_in_frame(a, b, shape->plane.n, shape->polygon[1] - shape->polygon[0]));
  }
  return least;
}

double largest_distance(const FlatShape& a, const FlatShape& b) {
  double most = 0.0;
  for (const Vec3& p : a.polygon) {
    for (const Vec3& q : b.polygon) most = std::max(most, glm::dot(q - p, q - p));
  }
  return std::sqrt(most);
}

double most_by_facing(const Vec3& n, const Vec3& m) {
  return std::clamp(0.5 * (1.0 - glm::dot(n, m)), 0.0, 1.0);
}

}  // namespace enfilade
