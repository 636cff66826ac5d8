// The shape of an input polygon, and its planar convex parts.
#pragma once

#include <vector>

#include "scene/scene_scale.hpp"

namespace enfilade {

enum class PolygonShape { convex, degenerate, non_planar, non_convex, self_intersecting };

struct ConvexParts {
  PolygonShape shape = PolygonShape::convex;
  std::vector<Polygon> parts;  ///< none where degenerate or self-intersecting
};

/// Repeated vertices and spikes are taken out first. A planar, convex polygon keeps all its other
/// vertices, but those that lie inside its hull by no more than the scale's tolerance.
ConvexParts convex_parts(const Polygon& polygon, const SceneScale& scale);

/// How thin a polygon is: the farthest that a vertex lies from a line through two far corners.
double width_of(const Polygon& polygon);

}  // namespace enfilade
