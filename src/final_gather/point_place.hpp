// Where a point lies: on which polygon, and where rays from it start.
#pragma once

#include <cstdint>

#include "occluders/occluders.hpp"

namespace enfilade {

/// Returns the polygon (global number, the lowest of several) that p lies on, to within the
/// distance that rays skip at their start, and that faces the same way; else RayScene::no_polygon.
std::uint32_t surface_at(const Occluders& occluders, const Vec3& p, const Vec3& n);
/// Returns p moved off its surface, and off the walls that rise beside it: at the edge of a floor
/// the point would else lie behind the wall, where it is dark.
Vec3 lifted(const Occluders& occluders, const Vec3& p, const Vec3& n);

}  // namespace enfilade
