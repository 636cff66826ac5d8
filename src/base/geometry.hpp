// Vectors and axis-aligned boxes.
#pragma once

#include <algorithm>
#include <array>
#include <glm/glm.hpp>
#include <limits>

namespace enfilade {

using Vec2 = glm::dvec2;
using Vec3 = glm::dvec3;

/// Returns the third component of the cross product of two vectors of the plane: twice the signed
/// area of their triangle.
inline double cross2(const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; }

/// Returns the coordinate axis that is farthest from the direction of n, as a unit vector; of
/// equals the first.
inline Vec3 least_axis(const Vec3& n) {
  const Vec3 a = glm::abs(n);
  if (a.x <= a.y && a.x <= a.z) return {1.0, 0.0, 0.0};
  return a.y <= a.z ? Vec3(0.0, 1.0, 0.0) : Vec3(0.0, 0.0, 1.0);
}

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
  /// 0 = x, 1 = y, 2 = z; of equals the first.
  int longest_axis() const {
    const Vec3 e = extent();
    return e.x >= e.y && e.x >= e.z ? 0 : e.y >= e.z ? 1 : 2;
  }
  /// Bit 0 of a corner's number says that it lies at the upper end in x, bit 1 in y, bit 2 in z.
  std::array<Vec3, 8> corners() const {
    std::array<Vec3, 8> found;
    for (std::size_t i = 0; i < found.size(); ++i)
      found[i] = {i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y, i & 4 ? hi.z : lo.z};
    return found;
  }
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

/// Returns the distance between two boxes; 0 where they overlap.
inline double gap_m(const Box& a, const Box& b) {
  return glm::length(glm::max(Vec3(0.0), glm::max(a.lo - b.hi, b.lo - a.hi)));
}

}  // namespace enfilade
