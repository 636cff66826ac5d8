// The light of several groups at once: each group's share is a set of further bands beside the
// whole light, so that whatever is linear in the light is done for all of them together.
#pragma once

#include <span>

#include "clusters/cluster.hpp"
#include "hierarchy/cluster_state.hpp"
#include "shares/share_groups.hpp"

namespace enfilade {

/// Returns where band b (of `bands`) of a share lies among the bands of a share_scene().
inline std::size_t share_band(std::size_t bands, std::size_t share, std::size_t b) {
  return (1 + share) * bands + b;
}

/// Returns the scene with its own bands first, which lead (Scene::lead_bands), and then for each
/// group as many bands in which that group alone emits. Without the scene's text.
Scene share_scene(const Scene& scene, std::span<const ShareGroup> groups);

/// Returns the scene with the light of group i times factors[i] (0 or more).
Scene dimmed_scene(const Scene& scene, std::span<const ShareGroup> groups,
                   std::span<const double> factors);

/// ClusterState::iteration() of a cluster that has its links, and no light of this run yet.
constexpr int gathered_before = -1;

/// Returns a cluster of `scene`, which has the same geometry as that of `state` and other bands,
/// reflectances or exitances: with the same patches, enclosed shares, unreachable polygons and
/// links. It has no light but its exitance. `aggregates`: at most so many; 0 = as `state`.
ClusterState same_patches(const ClusterState& state, const Cluster& cluster, const Scene& scene,
                          std::size_t aggregates = 0);

}  // namespace enfilade
