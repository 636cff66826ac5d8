// Footprints: outlines of polygons seen from above, and the largest circle in them, for labels.
#pragma once

#include <span>
#include <vector>

#include "geometry/polygon.hpp"

namespace enfilade {

/// Returns rings (outlines and holes) of the union of the polygons seen from above. Upright
/// polygons add nothing. Outlines first turn clockwise, holes counter-clockwise. With `snap_m`
/// above 0, corners are moved to a grid of that width, so that neighbours which meet but for
/// rounding become one.
std::vector<std::vector<Vec2>> footprint(std::span<const Polygon> polygons, double snap_m = 0.0);

/// A circle within the polygons.
struct InnerCircle {
  Vec2 centre{0.0};
  double radius_m = 0.0;
};
/// Returns the largest circle in the union of the polygons, to 1% of its size; radius 0 where there
/// is none.
InnerCircle largest_circle(std::span<const Polygon> polygons);

}  // namespace enfilade
