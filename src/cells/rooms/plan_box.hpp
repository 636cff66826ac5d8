// A rectangle in plan around points, and where a region lies against it.
#pragma once

#include <array>
#include <vector>

#include "geometry/convex.hpp"

namespace enfilade {

/// A rectangle in plan along two level directions u and v: a box without a floor or a ceiling.
struct PlanBox {
  Vec3 u{0.0}, v{0.0};
  double u0 = 0.0, u1 = 0.0, v0 = 0.0, v1 = 0.0;  ///< metres along u and v

  double area_m2() const { return (u1 - u0) * (v1 - v0); }
  bool contains(const Vec3& p) const;
  enum class Position { outside, across, inside };
  /// Outside where the region lies beyond one of the sides.
  Position position_of(const Region& region) const;
  /// The part of a region that lies in the box; without facets where there is none.
  Region part_of(const Region& region) const;
  /// Around the plan box, at all heights.
  Box bounds(const Vec3& up) const;
  /// The planes of the four sides; their fronts are outside the box.
  std::array<Plane, 4> sides() const {
    return {Plane{u, u1}, Plane{-u, -u0}, Plane{v, v1}, Plane{-v, -v0}};
  }
};

/// The box around all points in plan, along the longest edge of their convex hull. Of no area where
/// the points have none.
PlanBox box_around(const std::vector<Vec3>& points, const Vec3& up);

}  // namespace enfilade
