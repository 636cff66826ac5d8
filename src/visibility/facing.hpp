// Which one-sided polygons face each other: others exchange no light.
#pragma once

#include <span>

#include "visibility/portal_search.hpp"

namespace enfilade {

/// A point closer than this to a plane lies in it, in all plane tests of visibility. It stands for
/// the rounding of turned and moved coordinates, far below the precision of a scene file.
inline double rounding_m(double tolerance_m) { return 1e-3 * tolerance_m; }

/// True where the polygon has a vertex more than `flat_m` in front of the plane.
bool any_in_front(const Polygon& polygon, const Plane& plane, double flat_m);
/// True where the box has a corner more than `flat_m` in front of the plane.
bool any_in_front(const Box& box, const Plane& plane, double flat_m);

/// True where there are a polygon of a and one of b, each with some of the other in front of it.
bool face_each_other(std::span<const SourcePolygon> a, const Box& a_box,
                     std::span<const SourcePolygon> b, const Box& b_box, double flat_m);

}  // namespace enfilade
