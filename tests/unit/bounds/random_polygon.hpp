// Polygons of random places and shapes for tests of bounds.
#pragma once

#include "base/random.hpp"
#include "bounds/factors/flat_shape.hpp"

namespace enfilade {

inline Vec3 random_place(Random& random, double size) {
  return size * Vec3(random.uniform(), random.uniform(), random.uniform());
}

/// A triangle, rectangle or parallelogram of a random place and direction.
inline Polygon random_polygon(Random& random, double size) {
  const Vec3 a = random_place(random, 2.0);
  Vec3 u = random_place(random, size) - Vec3(0.5 * size),
       v = random_place(random, size) - Vec3(0.5 * size);
  switch (random.below(3)) {
    case 0:
      return {a, a + u, a + v};
    case 1:
      v -= glm::dot(u, v) / glm::dot(u, u) * u;
      break;
    default:
      break;
  }
  return {a, a + u, a + u + v, a + v};
}

inline FlatShape shape(const Polygon& polygon) { return {polygon, plane_of(polygon)}; }

}  // namespace enfilade
