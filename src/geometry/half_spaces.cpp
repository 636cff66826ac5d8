#include "geometry/half_spaces.hpp"

#include <algorithm>
#include <cmath>

namespace enfilade {

void add_penumbra(std::span<const Vec3> source, const Polygon& window, const Vec3& n,
                  double slack_m, HalfSpaces& out) {
  const Vec3 middle = centroid(window);
  for (std::size_t i = 0; i < window.size(); ++i) {
    const Vec3& a = window[i];
    const Vec3 edge = window[(i + 1) % window.size()] - a;
    Vec3 inward = glm::cross(n, edge);
    const double length = glm::length(inward);
    if (length <= slack_m) continue;
    inward /= length;
    if (glm::dot(inward, middle - a) < 0.0) inward = -inward;
    // Seen along the edge, a source point lies at (x, -h). Of the lines through the edge the lowest
    // beyond the window comes from the point with the largest x / h.
    double slope = -1e30;
    for (const Vec3& p : source) {
      const double x = glm::dot(inward, p - a) + slack_m;
      const double h = -glm::dot(n, p - a);
      const double near_h = std::max(h - slack_m, 1e-3 * slack_m),
                   far_h = std::max(h, 0.0) + slack_m;
      slope = std::max(slope, x > 0.0 ? x / near_h : x / far_h);
    }
    const Vec3 m = glm::normalize(inward + std::clamp(slope, -1e9, 1e9) * n);
    out.push_back({m, glm::dot(m, a) - slack_m});
  }
}

bool outside(const Polygon& polygon, const HalfSpaces& spaces, double slack_m) {
  return std::any_of(spaces.begin(), spaces.end(), [&](const Plane& plane) {
    return std::all_of(polygon.begin(), polygon.end(),
                       [&](const Vec3& p) { return plane.signed_distance(p) < -slack_m; });
  });
}

bool outside(const Box& box, const HalfSpaces& spaces, double slack_m) {
  return std::any_of(spaces.begin(), spaces.end(),
                     [&](const Plane& plane) { return highest_distance(box, plane) < -slack_m; });
}

Polygon clip_to(Polygon polygon, const HalfSpaces& spaces, double slack_m) {
  for (const Plane& plane : spaces) {
    clip_front(polygon, {plane.n, plane.d - slack_m}, 0.0);
    if (polygon.empty()) break;
  }
  return polygon;
}

}  // namespace enfilade
