// Polygons that are estimated to receive no light: those inside walls and furniture. No light is
// gathered for them, so that coarse first links leave none on them.
#pragma once

#include <span>
#include <vector>

#include "base/work_count.hpp"
#include "clusters/cluster.hpp"
#include "occluders/occluders.hpp"
#include "scene/scene.hpp"

namespace enfilade {

struct UnreachablePolygonsConfig {
  /// Of the scene's mean irradiance: a polygon with less, and without exitance, is a candidate.
  double share = 1e-4;
  /// Rays per polygon at first, and more for each candidate; a quarter of these where random walks
  /// found no light either (ClusterPolygon::walked_dark). The fewer polygons there are, the more
  /// rays each has (least_rays), so that an opening of a hollow that all rays miss must be small.
  int rays = 16, more_rays = 128;
  int least_rays = 1 << 17;  ///< all polygons together, and again all candidates together
};

/// Returns one entry per polygon, by its global number in `occluders`: 1 = unreachable, that is
/// estimated to receive no light. By a rough solution of the radiosity equation: one value per
/// polygon, direct light by rays from the emitters, form factors by rays. A polygon that emits, or
/// that sees an emitter's centroid or a point light, is never unreachable.
std::vector<char> unreachable_polygons(const Scene& scene, std::span<const Cluster> clusters,
                                       const Occluders& occluders, WorkCount& work,
                                       const UnreachablePolygonsConfig& config = {});

}  // namespace enfilade
