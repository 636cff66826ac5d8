// Which one-sided polygons have each other before them: those behind each other exchange no light.
#pragma once

#include <span>

#include "visibility/portal_search.hpp"

namespace enfilade {

/// Has the polygon a vertex in front of the plane?
bool any_in_front(const Polygon& polygon, const Plane& plane);
/// Has the box a corner in front of the plane?
bool any_in_front(const Box& box, const Plane& plane);

/// Is there a polygon of a and one of b, each with some of the other in front of it?
bool face_each_other(std::span<const SourcePolygon> a, const Box& a_box,
                     std::span<const SourcePolygon> b, const Box& b_box);

}  // namespace enfilade
