// Footprints: outlines of many polygons seen from above, and where a word fits into them.
#pragma once

#include <span>
#include <vector>

#include "geometry/polygon.hpp"

namespace enfilade {

/// Rings of the union of the polygons seen from above (holes too); polygons that stand have none.
std::vector<std::vector<Vec2>> footprint(std::span<const Polygon> polygons);

/// A circle within the polygons.
struct InnerCircle {
  Vec2 centre{0.0};
  double radius_m = 0.0;
};
/// The largest one in the union of the polygons, to 1% of its size; radius 0 where there is none.
InnerCircle largest_circle(std::span<const Polygon> polygons);

}  // namespace enfilade
