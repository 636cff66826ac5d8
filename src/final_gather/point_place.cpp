#include "final_gather/point_place.hpp"

#include <algorithm>

#include "geometry/polygon.hpp"

namespace enfilade {

std::uint32_t surface_at(const Occluders& occluders, const Vec3& p, const Vec3& n) {
  for (const std::uint32_t k : occluders.touching(p, 4.0 * occluders.rays().epsilon_m())) {
    if (glm::dot(normal(occluders.polygon(k)), n) > 0.999) return k;
  }
  return RayScene::no_polygon;
}

Vec3 lifted(const Occluders& occluders, const Vec3& p, const Vec3& n) {
  const double step_m = 2.0 * occluders.rays().epsilon_m();
  const Vec3 above = p + step_m * n;
  std::vector<Vec3> away;
  for (const std::uint32_t k : occluders.touching(p, step_m)) {
    const Polygon& wall = occluders.polygon(k);
    const bool rises = std::any_of(
        wall.begin(), wall.end(), [&](const Vec3& v) { return glm::dot(n, v - p) > 4.0 * step_m; });
    const Plane plane = plane_of(wall);
    // Between two walls back to back either side may be meant: that of the first in the file.
    const bool opposed = std::any_of(away.begin(), away.end(),
                                     [&](const Vec3& o) { return glm::dot(plane.n, o) < -0.999; });
    if (rises && !opposed && plane.signed_distance(above) < step_m) away.push_back(plane.n);
  }
  Vec3 x = above;
  for (const Vec3& m : away) {
    const double short_m = step_m - glm::dot(m, x - above);
    if (short_m > 0.0) x += short_m * m;
  }
  return x;
}

}  // namespace enfilade
