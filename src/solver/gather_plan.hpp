// The configuration of gathers from an iteration's plan, and the clusters at the start of a solve.
#pragma once

#include <span>
#include <vector>

#include "base/work_count.hpp"
#include "gather/gather.hpp"
#include "solver/iteration_method.hpp"
#include "solver/iteration_plan.hpp"

namespace enfilade {

/// The settings that stay the same over all gathers of a solve.
struct GatherSettings {
  Basis basis = Basis::linear;
  int max_depth = 20;        ///< binary splits below a polygon
  double min_area_m2 = 0.0;  ///< no patch is split below this
  OracleKind oracle = OracleKind::error;
  VisibilityMethod visibility = VisibilityMethod::exact;
  /// Where errors matter; none = everywhere alike.
  std::vector<Probe> target_points;
};

/// Returns the configuration of the gathers of an iteration. `area_m2`: of all clusters; error
/// samples are spread over it. `importance`: RefinementConfig::importance, which the result refers
/// to.
GatherConfig gather_config(const IterationPlan& plan, const GatherSettings& settings,
                           const IterationMethod& method, double area_m2,
                           std::span<const float> importance);

/// Makes the clusters as they are before the first iteration: one patch per polygon, radiosity =
/// exitance, no links, unreachable polygons marked. Finding these takes rays, which `work` counts.
class InitialClusters {
 public:
  /// All must outlive it.
  InitialClusters(const Scene& scene, std::span<const Cluster> clusters, const Occluders& occluders,
                  const CoarseUnknowns& unknowns, Basis basis, WorkCount& work);
  ClusterState make(ClusterId id) const;

 private:
  const Scene& scene_;
  std::span<const Cluster> clusters_;
  const Occluders& occluders_;
  const CoarseUnknowns& unknowns_;
  Basis basis_;
  std::vector<char> unreachable_;  ///< by global polygon
};

}  // namespace enfilade
