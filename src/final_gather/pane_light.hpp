// The light of panes along the rays of a gather at a point.
#pragma once

#include "final_gather/emitter_sampler.hpp"

namespace enfilade {

/// A ray of a path, up to what it hits; `own`: the polygon that it starts from.
struct PathLeg {
  const Vec3 &from, &direction;
  const RayHit& hit;
  std::uint32_t own;
};

/// Adds what the fronts of the panes along a leg send, as their patches have it, times what the
/// path carries (per band); then dims what it carries. `control`: of a path's first leg, whose part
/// at these fronts is subtracted; else null. Returns false where there is no pane.
bool add_pane_light(const PathLeg& leg, std::span<const ClusterState> clusters,
                    const Occluders& occluders, const EmitterSampler& emitters,
                    const EmitterSampler::ControlVariate* control, std::vector<double>& carried,
                    Spectrum& e);

}  // namespace enfilade
