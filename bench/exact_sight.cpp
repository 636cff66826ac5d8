#include "exact_sight.hpp"

#include <algorithm>
#include <cmath>

namespace enfilade::bench {
namespace {

// Of the largest coordinate: a few of a double's steps, as points on polygons are computed.
constexpr double rounding_relative = 4e-15;

}  // namespace

ExactSight::ExactSight(std::span<const Polygon> polygons) {
  Box box;
  for (const Polygon& polygon : polygons) box.add(bounds(polygon));
  const Vec3 largest = glm::max(glm::abs(box.lo), glm::abs(box.hi));
  rounding_m_ = rounding_relative * std::max({largest.x, largest.y, largest.z, box.diagonal()});
  std::vector<Box> boxes;
  for (std::uint32_t i = 0; i < polygons.size(); ++i) {
    const Polygon& p = polygons[i];
    for (std::size_t k = 2; k < p.size(); ++k) {
      const Polygon triangle{p[0], p[k - 1], p[k]};
      parts_.push_back({triangle, plane_of(triangle), i});
      boxes.push_back(bounds(triangle));
    }
  }
  tree_ = std::make_unique<BoxTree>(boxes);
}

bool ExactSight::blocks(const Part& part, const Vec3& a, const Vec3& b) const {
  const double da = part.plane.signed_distance(a), db = part.plane.signed_distance(b);
  if (std::min(da, db) >= -rounding_m_ || std::max(da, db) <= rounding_m_) return false;
  const Vec3 hit = a + da / (da - db) * (b - a);
  for (std::size_t i = 0; i < part.polygon.size(); ++i) {
    const Vec3& p = part.polygon[i];
    const Vec3 edge = part.polygon[(i + 1) % part.polygon.size()] - p;
    const double inside_m = glm::dot(glm::cross(part.plane.n, edge), hit - p);
    // No line passes between two polygons that share an edge.
    if (inside_m < -rounding_m_ * glm::length(edge)) return false;
  }
  return true;
}

bool ExactSight::open(const Vec3& a, const Vec3& b, std::uint32_t of_a, std::uint32_t of_b) const {
  // In steps, so that a long slanted segment does not ask for half of the building.
  constexpr int steps = 8;
  for (int k = 0; k < steps; ++k) {
    Box box;
    box.add(a + (b - a) * (static_cast<double>(k) / steps));
    box.add(a + (b - a) * ((k + 1.0) / steps));
    for (const std::uint32_t i : tree_->touching(box, rounding_m_)) {
      const Part& part = parts_[i];
      if (part.of != of_a && part.of != of_b && blocks(part, a, b)) return false;
    }
  }
  return true;
}

}  // namespace enfilade::bench
