// What each gather of a run cost: written while it runs, so that the run can be replayed on other
// clusters of computers without its kernels.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "coarse/coarse_unknowns.hpp"
#include "solver/iteration_plan.hpp"
#include "store/resident_clusters.hpp"

namespace enfilade {

/// One gather of one cluster: GathersParallel(C) and WriteOnLocalDirectory(C) of figure 2.
struct GatherCost {
  ClusterId cluster;
  IterationFigures sums;         ///< what it brought; its work among them
  SectionWeight patches, links;  ///< as it wrote them
  std::vector<std::uint32_t>
      coupled;  ///< in the coarse system, if any: column + unknowns * aggregate
};

/// Whose light a gather takes: what the recorded iterations are true for.
struct IterationMethod {
  bool coarse_correction = true;
  bool jacobi = false;

  /// Zones serve the coarse correction alone.
  CoarseUnknowns unknowns(std::span<const Cluster> clusters) const {
    return coarse_correction ? coarse_unknowns(clusters) : coarse_unknowns(clusters, 1);
  }
  /// The light as committed, rather than a rank's newest as in the paper. What is refined must not
  /// depend on the ranks' number and speeds; light then spreads as with Jacobi, which the coarse
  /// correction makes up for. And where that has several unknowns a cluster, all must have been
  /// seen by the same receivers, else how their light was shared out would pass for power.
  bool uses_jacobi(const IterationPlan& plan, const CoarseUnknowns& unknowns) const {
    return jacobi || (coarse_correction && (plan.refine || plan.sample || unknowns.aggregated()));
  }
};

/// A run that can be replayed.
struct Recording {
  std::vector<ClusterWeight> start;              ///< by cluster, before the first iteration
  std::vector<std::vector<GatherCost>> gathers;  ///< [iteration - 1][cluster]
  std::vector<IterationSummary> history;         ///< what the iterations came to
  std::size_t bands = 1;
  IterationMethod light;
  Basis basis = Basis::linear;

  /// What a cluster's sections weigh once iteration `iteration` is over; 0 = at the start.
  ClusterWeight weight(ClusterId cluster, int iteration) const;
};

/// Takes down one rank's gathers, in RUN/costs/<iteration>/rank-<n>.
class CostRecorder {
 public:
  CostRecorder(std::string run_directory, Rank rank, IterationMethod light)
      : directory_(run_directory + "/costs/"), rank_(rank), light_(light) {}

  /// A cluster before the first iteration.
  void add_start(const ClusterState& state);
  void add(GatherCost cost) { gathers_.push_back(std::move(cost)); }
  /// The iteration's gathers go to their file, all at once; 0 = the clusters at the start.
  void write(int iteration);

 private:
  std::string directory_;
  Rank rank_;
  IterationMethod light_;
  std::vector<std::pair<ClusterId, ClusterWeight>> start_;
  std::vector<GatherCost> gathers_;
};

/// On one rank, before a run begins: takes away what was recorded after `committed`.
void drop_costs(const std::string& run_directory, int committed);
/// Throws InputError where RUN holds no finished run with all its costs.
Recording read_recording(const std::string& run_directory, std::size_t clusters);

}  // namespace enfilade
