// Which polygons no light to speak of can reach: the insides of walls and of furniture. Nobody
// looks for their light, and none is left there by links that were coarse at first.
#pragma once

#include <span>
#include <vector>

#include "base/work_count.hpp"
#include "clusters/cluster.hpp"
#include "occluders/occluders.hpp"
#include "scene/scene.hpp"

namespace enfilade {

struct DarkConfig {
  double share = 1e-4;  ///< of the scene's mean irradiance: less is dark
  /// Rays a polygon at first, and once more where it seems dark. Few polygons get more: an opening
  /// that all rays from a hollow miss must be small.
  int rays = 16, more_rays = 128;
  int least_rays = 1 << 17;  ///< all polygons together, and the same for those that seem dark
};

/// One entry a polygon, by its global number in `occluders`: 1 = dark. A rough solution of the
/// radiosity equation, one value a polygon: lamps shine along rays of their own, all else is
/// gathered along rays. No polygon is dark that emits or that sees the middle of a lamp.
std::vector<char> unreachable_polygons(const Scene& scene, std::span<const Cluster> clusters,
                                       const Occluders& occluders, WorkCount& work,
                                       const DarkConfig& config = {});

}  // namespace enfilade
