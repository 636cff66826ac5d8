// Directions drawn by their cosine.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/geometry.hpp"

namespace enfilade {

/// Direction above a plane with unit normal n; uniform r2 and turn (of a circle) in [0, 1) give
/// directions in proportion to their cosine with n.
inline Vec3 cosine_direction(const Vec3& n, double r2, double turn) {
  const Vec3 helper = std::abs(n.x) < 0.6 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  const Vec3 u = glm::normalize(glm::cross(helper, n)), v = glm::cross(n, u);
  const double phi = 2.0 * std::numbers::pi * turn, r = std::sqrt(r2);
  return r * std::cos(phi) * u + r * std::sin(phi) * v + std::sqrt(std::max(0.0, 1.0 - r2)) * n;
}

}  // namespace enfilade
