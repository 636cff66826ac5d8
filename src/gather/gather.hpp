// Gathering for one receiving cluster: refine, form factors, visibility, gather, push-pull (figure
// 3).
#pragma once

#include <functional>
#include <span>

#include "base/work_count.hpp"
#include "coarse/coarse_correction.hpp"
#include "gather/iteration_figures.hpp"
#include "hierarchy/cluster_state.hpp"
#include "links/link_refinement.hpp"
#include "occluders/occluders.hpp"

namespace enfilade {

struct GatherConfig {
  RefinementConfig refinement;
  int iteration = 1;   ///< the receiver is marked with it; shooters marked so are its newer values
  bool refine = true;  ///< false: gather over the links as they are
  bool coarse_row = true;  ///< false: GatherResult::coarse has no entries
  /// Close the rows: where every ray from a patch ends on a lit front side its form factors must
  /// sum to 1; what is missing goes to its links by how doubtful each is. Wanted once light has
  /// reached everything.
  bool close_rows = false;
  /// Per band, with closed rows: share of its links' doubtful light that each patch gets on top (or
  /// loses), so that what leaves the surfaces arrives; empty = none.
  Spectrum flux_correction;
  ErrorSampleConfig error_samples;  ///< none at first
};

/// What one gather did: its figures, and its row of the coarse correction.
struct GatherResult {
  IterationFigures figures;
  CoarseRow coarse;
  bool links_changed = false;  ///< the receiver's links are others than before the gather
};

/// Brings in a visible cluster; what it returns need stay valid only until the next call.
using ShooterSource = std::function<const ClusterState&(ClusterId)>;

/// Gathers for `receiver` from the lights, then from each visible cluster, itself among them, in
/// ascending order: no more than two clusters need be in memory at once. Changes the receiver's
/// patches and links only.
GatherResult gather(ClusterState& receiver, std::span<const ClusterId> visible,
                    const ShooterSource& shooter, std::span<const PointLight> lights,
                    const Occluders& occluders, const GatherConfig& config);

/// Power that the scene's surfaces and lights emit, per band: what errors and tolerances are
/// relative to.
Spectrum emitted_power(const Scene& scene, std::span<const Cluster> clusters);

}  // namespace enfilade
