#include "visibility/facing.hpp"

#include <algorithm>

namespace enfilade {

bool any_in_front(const Polygon& polygon, const Plane& plane) {
  return std::any_of(polygon.begin(), polygon.end(),
                     [&](const Vec3& p) { return plane.signed_distance(p) > 0.0; });
}

bool any_in_front(const Box& box, const Plane& plane) {
  const Vec3 half = 0.5 * box.extent();
  return plane.signed_distance(box.center()) + glm::dot(glm::abs(plane.n), half) > 0.0;
}

bool face_each_other(std::span<const SourcePolygon> a, const Box& a_box,
                     std::span<const SourcePolygon> b, const Box& b_box) {
  for (const SourcePolygon& p : a) {
    if (!any_in_front(b_box, p.plane)) continue;
    for (const SourcePolygon& q : b) {
      if (!any_in_front(a_box, q.plane)) continue;
      if (any_in_front(q.polygon, p.plane) && any_in_front(p.polygon, q.plane)) return true;
    }
  }
  return false;
}

}  // namespace enfilade
