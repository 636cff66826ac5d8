// RUN/stats.json: the counts of all ranks, put together on rank 0.
#pragma once

#include <vector>

#include "base/run_record.hpp"
#include "comm/communicator.hpp"
#include "run/prepare.hpp"
#include "solver/iteration_plan.hpp"
#include "store/cluster_store.hpp"
#include "store/resident_clusters.hpp"

namespace enfilade {

/// One rank's counts of a solve.
struct RankStatistics {
  TimeUse time;
  double span_s = 0.0;  ///< by Machine::now_s(), from the start of the first iteration to the end
  StoreCount store;
  ResidencyCount residency;
  MessageCount sent;
};

/// All ranks call it. Returns the record on rank 0, without wall_s and solve_s; elsewhere an empty
/// one.
RunRecord gather_statistics(const Prepared& prepared, Basis basis, const Spectrum& emitted,
                            const std::vector<IterationSummary>& history, const IterationPlan& last,
                            const RankStatistics& own, Communicator& communicator,
                            const Machine& machine);

}  // namespace enfilade
