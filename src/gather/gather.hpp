// Gathering for one receiving cluster (figure 3): refine its links, gather over them, close the
// rows of form factors, push and pull.
#pragma once

#include <functional>
#include <span>

#include "base/work_count.hpp"
#include "coarse/coarse_row.hpp"
#include "coarse/far_flow.hpp"
#include "far_field/far_view.hpp"
#include "gather/iteration_figures.hpp"
#include "gather/row_closure.hpp"
#include "hierarchy/cluster_state.hpp"
#include "links/link_refinement.hpp"
#include "occluders/occluders.hpp"

namespace enfilade {

struct GatherConfig {
  RefinementConfig refinement;
  /// Set in the receiver; a shooter with this number already has this iteration's light.
  int iteration = 1;
  bool refine = true;      ///< false: gather over the links as they are
  bool coarse_row = true;  ///< false: GatherResult::coarse has no entries
  /// Close the rows of form factors (row_closure.hpp). Wanted once light has reached everything.
  bool close_rows = false;
  OpennessRays openness_rays;
  /// Per band, with closed rows: the share of its uncertain irradiance that each leaf gains (below
  /// zero: loses), so that power is conserved over the whole scene
  /// (solver/energy_conservation.hpp). Empty = none.
  Spectrum flux_correction;
  /// The light of shares (Scene::lead_bands) changes by this factor times the change that the
  /// gather finds; that of the lead bands not at all. Without shares, all light is as gathered.
  double relaxation = 1.0;
  /// Above 1: how many times as far as this and the last gather together have brought it the light
  /// within each aggregate goes (extrapolate.hpp). From 1 on, the light is kept for that; 0 = not.
  double extrapolation = 0.0;
  ErrorSampleConfig error_samples;  ///< by default there are none
};

/// The figures of one gather, and the receiver's row of the coarse system.
struct GatherResult {
  IterationFigures figures;
  CoarseRow coarse;
  bool links_changed = false;  ///< the gather changed the links
  ClusterLight light;          ///< of the receiver after the gather, where there is a far field
};

/// The clusters that a receiver gathers from: those of a list, or those that it finds through the
/// building's tree.
struct Shooters {
  std::span<const ClusterId>
      listed;  ///< ascending; contains the receiver. Ignored with a far field
  const FarField* far = nullptr;
  const FarUnknowns* unknowns = nullptr;  ///< with a far field and a coarse system
  /// False where cells and portals prove that the receiver sees no place outside the building, so
  /// that sky, sun and ground send it nothing.
  bool outside = true;
  /// True where it is certain that the light sends the receiver nothing.
  bool shut_out(const LightSource& light) const { return light.is_far() && !outside; }
};

/// Returns a visible cluster, which need stay valid only until the next call.
using ShooterSource = std::function<const ClusterState&(ClusterId)>;

/// Gathers for `receiver` from the lights, then from far shooters, then from clusters in ascending
/// order. No more than two clusters need be in memory at once. Changes the receiver's patches and
/// links only.
GatherResult gather(ClusterState& receiver, const Shooters& shooters, const ShooterSource& shooter,
                    std::span<const LightSource> lights, const Occluders& occluders,
                    const GatherConfig& config);

}  // namespace enfilade
