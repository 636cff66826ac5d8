// How open the hemisphere above a patch is, by rays.
#pragma once

#include <functional>

#include "base/work_count.hpp"
#include "hierarchy/cluster_state.hpp"
#include "occluders/occluders.hpp"

namespace enfilade {

/// Whether the front side of a polygon that a ray ends on counts.
using EndsRay = std::function<bool(const PolygonRef&)>;

/// Share (0 .. 1) of the cosine-weighted rays from all over patch `node` that end on a front side
/// which counts. `rings` * `rings` strata from each quarter of the patch, so 4 rings^2 rays.
double enclosed_share(const ClusterState& cluster, const PatchNode& node, int rings,
                      const Occluders& occluders, const EndsRay& ends, WorkCount& work);

}  // namespace enfilade
