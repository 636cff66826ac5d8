// Tests of polygons and boxes against planes.
#include "visibility/facing.hpp"

#include <algorithm>

namespace enfilade {

bool any_in_front(const Polygon& polygon, const Plane& plane, double flat_m) {
  return std::any_of(polygon.begin(), polygon.end(),
                     [&](const Vec3& p) { return plane.signed_distance(p) > flat_m; });
}

bool any_in_front(const Box& box, const Plane& plane, double flat_m) {
  return highest_distance(box, plane) > flat_m;
}

bool face_each_other(std::span<const SourcePolygon> a, const Box& a_box,
                     std::span<const SourcePolygon> b, const Box& b_box, double flat_m) {
  for (const SourcePolygon& p : a) {
    if (!any_in_front(b_box, p.plane, flat_m)) continue;
    for (const SourcePolygon& q : b) {
      if (!any_in_front(a_box, q.plane, flat_m)) continue;
      if (any_in_front(q.polygon, p.plane, flat_m) && any_in_front(p.polygon, q.plane, flat_m))
        return true;
    }
  }
  return false;
}

}  // namespace enfilade
