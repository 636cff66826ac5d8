// Gathering for one receiving cluster: refine, form factors, visibility, gather, push-pull (figure
// 3).
#pragma once

#include <span>

#include "base/work_count.hpp"
#include "radiosity/cluster_state.hpp"
#include "radiosity/coarse_correction.hpp"
#include "radiosity/occluders.hpp"

namespace enfilade {

struct GatherConfig {
  /// A link whose estimated error is above this is refined. Power: area times irradiance, the
  /// scene's unit times m2, in the worst band.
  double link_tolerance = 0.0;
  int iteration = 1;   ///< the receiver is marked with it; shooters marked so are its newer values
  bool refine = true;  ///< false: gather over the links as they are
  /// Close the rows: where every ray from a patch ends on a lit front side its form factors must
  /// sum to 1; what is missing goes to its links by how doubtful each is. Wanted once light has
  /// reached everything.
  bool close_rows = false;
  int max_depth = 20;        ///< binary splits below a polygon
  double min_area_m2 = 0.0;  ///< no patch is split below this
};

/// What one gather did; figures are summed or maximised over clusters by `parallel`.
struct GatherResult {
  WorkCount work;
  double max_change = 0.0;        ///< max |B(k) - B(k-1)| over patches and bands (§3.3.4)
  double change_power = 0.0;      ///< sum of area |B(k) - B(k-1)|, worst band
  double received_power = 0.0;    ///< sum of area * irradiance over the cluster, worst band
  double link_error_power = 0.0;  ///< sum of the estimated errors of its links, in power
  CoarseRow coarse;               ///< its row of the coarse correction
  Spectrum absorbed_power;        ///< per band: sum of area (1 - reflectance) irradiance
};

/// Gathers for `receiver` from itself, from `shooters` (the clusters visible to it, any order) and
/// from the lights. Reads the shooters only; changes the receiver's patches and links.
GatherResult gather(ClusterState& receiver, std::span<const ClusterState* const> shooters,
                    std::span<const PointLight> lights, const Occluders& occluders,
                    const GatherConfig& config);

/// Power that the scene's surfaces and lights emit, per band: what errors and tolerances are
/// relative to.
Spectrum emitted_power(const Scene& scene, std::span<const Cluster> clusters);

}  // namespace enfilade
