// Gathering for one receiving cluster: refine, form factors, visibility, gather, push-pull (figure
// 3).
#pragma once

#include <functional>
#include <span>

#include "base/work_count.hpp"
#include "radiosity/cluster_state.hpp"
#include "radiosity/coarse_correction.hpp"
#include "radiosity/link_refinement.hpp"
#include "radiosity/occluders.hpp"
#include "radiosity/residual_samples.hpp"

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
  Spectrum mend;
  ResidualConfig residual;  ///< none at first
};

/// What one gather did; figures are summed or maximised over clusters by `parallel`.
struct GatherResult {
  WorkCount work;
  double max_change = 0.0;        ///< max |B(k) - B(k-1)| over patches and bands (§3.3.4)
  double change_power = 0.0;      ///< sum of area |B(k) - B(k-1)|, worst band
  double received_power = 0.0;    ///< sum of area * irradiance over the cluster, worst band
  double link_error_power = 0.0;  ///< sum of the estimated errors of its links, in power
  double link_doubt_power = 0.0;  ///< what of that is doubt about visibility
  CoarseRow coarse;               ///< its row of the coarse correction
  Spectrum arriving_power;        ///< per band: sum of area * irradiance
  Spectrum returning_power;       ///< per band: what of that was reflected, not sent out
  Spectrum absorbed_power;        ///< per band: sum of area (1 - reflectance) irradiance
  /// Per band: sum of area * radiosity * the share of a patch's exposure rays that end nowhere, on
  /// a black back or on a front in the dark.
  Spectrum escaping_power;
  Spectrum beamed_power;    ///< per band: power that came straight from point lights
  Spectrum doubtful_power;  ///< per band: what a mend of 1 would add
  ResidualSums residual;
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
