// Vectors and boxes that every room uses.
#pragma once

#include <algorithm>
#include <glm/glm.hpp>
#include <limits>

namespace enfilade {

using Vec2 = glm::dvec2;
using Vec3 = glm::dvec3;

/// Axis-aligned box, metres; empty until a point is added.
struct Box {
  Vec3 lo{std::numeric_limits<double>::infinity()};
  Vec3 hi{-std::numeric_limits<double>::infinity()};

  void add(const Vec3& p) {
    lo = glm::min(lo, p);
    hi = glm::max(hi, p);
  }
  void add(const Box& b) {
    lo = glm::min(lo, b.lo);
    hi = glm::max(hi, b.hi);
  }
  bool empty() const { return lo.x > hi.x; }
  Vec3 center() const { return 0.5 * (lo + hi); }
  Vec3 extent() const { return empty() ? Vec3(0.0) : hi - lo; }
  double diagonal() const { return glm::length(extent()); }
  bool overlaps(const Box& b, double tolerance = 0.0) const {
    return lo.x <= b.hi.x + tolerance && b.lo.x <= hi.x + tolerance && lo.y <= b.hi.y + tolerance &&
           b.lo.y <= hi.y + tolerance && lo.z <= b.hi.z + tolerance && b.lo.z <= hi.z + tolerance;
  }
  bool contains(const Vec3& p, double tolerance = 0.0) const {
    return p.x >= lo.x - tolerance && p.x <= hi.x + tolerance && p.y >= lo.y - tolerance &&
           p.y <= hi.y + tolerance && p.z >= lo.z - tolerance && p.z <= hi.z + tolerance;
  }
};

}  // namespace enfilade
