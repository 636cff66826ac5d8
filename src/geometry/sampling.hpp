// Points on polygons and directions, from uniform random numbers in [0, 1).
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "base/geometry.hpp"
#include "base/random.hpp"
#include "geometry/polygon.hpp"

namespace enfilade {

/// Direction above a plane with unit normal n; uniform r2 and turn (of a circle) in [0, 1) give
/// directions in proportion to their cosine with n: r2 is the square of the radius in the unit disc
/// under the hemisphere.
inline Vec3 cosine_direction(const Vec3& n, double r2, double turn) {
  const Vec3 helper = std::abs(n.x) < 0.6 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  const Vec3 u = glm::normalize(glm::cross(helper, n)), v = glm::cross(n, u);
  const double phi = 2.0 * std::numbers::pi * turn, r = std::sqrt(r2);
  return r * std::cos(phi) * u + r * std::sin(phi) * v + std::sqrt(std::max(0.0, 1.0 - r2)) * n;
}

/// Unit direction at height z in [-1, 1] and `turn` (of a circle) about the z axis; uniform z and
/// turn give all directions alike (Archimedes).
inline Vec3 sphere_direction(double z, double turn) {
  const double phi = 2.0 * std::numbers::pi * turn, r = std::sqrt(1.0 - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

/// Point of a triangle, uniform over its area for uniform r1, r2 (Turk 1990).
inline Vec3 point_in_triangle(const Vec3& a, const Vec3& b, const Vec3& c, double r1, double r2) {
  const double s = std::sqrt(r1);
  return (1.0 - s) * a + s * ((1.0 - r2) * b + r2 * c);
}

/// Point of a convex polygon with at least 3 corners: a triangle of the fan about its first corner,
/// each as likely as any other, then a point of it. Every point can be drawn, but not all parts of
/// equal area are equally likely.
inline Vec3 random_point(const Polygon& polygon, Random& random) {
  const std::size_t k = 2 + random.below(polygon.size() - 2);
  const double r1 = random.uniform(), r2 = random.uniform();
  return point_in_triangle(polygon[0], polygon[k - 1], polygon[k], r1, r2);
}

/// Point of a convex polygon of the plane with at least 3 corners and the area `area_m2`, uniform
/// over its area: r1 chooses a triangle of the fan about the first corner by its area, what is left
/// of r1 and r2 choose the point of it. Stratified r1 gives stratified points.
inline Vec2 uniform_point(std::span<const Vec2> polygon, double area_m2, double r1, double r2) {
  double pick = r1 * area_m2;
  std::size_t i = 2;
  Vec2 a = polygon[1] - polygon[0], b = polygon[2] - polygon[0];
  double area = 0.5 * cross2(a, b);
  while (pick > area && i + 1 < polygon.size()) {
    pick -= area;
    ++i;
    a = b;
    b = polygon[i] - polygon[0];
    area = 0.5 * cross2(a, b);
  }
  const double s = std::sqrt(area > 0.0 ? std::clamp(pick / area, 0.0, 1.0) : 0.0);
  return polygon[0] + s * ((1.0 - r2) * a + r2 * b);
}

/// The same for a polygon in space.
inline Vec3 uniform_point(const Polygon& polygon, double r1, double r2) {
  double whole = 0.0;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    whole += glm::length(glm::cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]));
  }
  double pick = r1 * whole;
  std::size_t i = 2;
  for (; i + 1 < polygon.size(); ++i) {
    const double part =
        glm::length(glm::cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]));
    if (pick < part) break;
    pick -= part;
  }
  const double part = glm::length(glm::cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]));
  return point_in_triangle(polygon[0], polygon[i - 1], polygon[i],
                           part > 0.0 ? std::clamp(pick / part, 0.0, 1.0) : 0.0, r2);
}

}  // namespace enfilade
