// The enclosed share of a patch, by rays: the share of its cosine-weighted hemisphere that ends on
// front sides that count. The rest is its openness.
#pragma once

#include <functional>

#include "base/work_count.hpp"
#include "hierarchy/cluster_state.hpp"
#include "occluders/occluders.hpp"

namespace enfilade {

/// Whether a ray counts that ends on the front side of this polygon.
using EndsRay = std::function<bool(const PolygonRef&)>;

/// What rays find around a patch.
struct EnclosedShare {
  double share = 0.0;    ///< 0 .. 1
  double pending = 0.0;  ///< front sides that were met and do not count, for each ray
};

/// Returns the share of cosine-distributed rays from random points of patch `node` that end on a
/// front side which counts. `rings` * `rings` strata of directions from each quarter of the patch,
/// so 4 rings^2 rays.
EnclosedShare enclosed_share(const ClusterState& cluster, const PatchNode& node, int rings,
                             const Occluders& occluders, const EndsRay& ends, WorkCount& work);

}  // namespace enfilade
