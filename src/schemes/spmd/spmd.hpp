// ParallelRadiosity(S) of figure 2: the loop that every rank runs.
#pragma once

#include <vector>

#include "schemes/protocol/convergence_monitor.hpp"
#include "schemes/spmd/progress_engine.hpp"
#include "schemes/spmd/task_list.hpp"

namespace enfilade {

struct SpmdConfig {
  bool steal = true;
  bool coarse_correction = true;  ///< false: the paper's iteration as it is
};

/// Runs iterations from `plan` on until one is the last. `changes` corrects the light of the
/// committed iteration (a resumed run; else empty). `history` holds the iterations before on rank 0
/// (empty for a new run), and grows there. Returns the plan that ended the run, on every rank.
IterationPlan run_spmd(ClusterWork& work, TaskList& tasks, Communicator& communicator,
                       Machine& machine, const SpmdConfig& config, IterationPlan plan,
                       std::vector<double> changes, std::vector<IterationSummary>& history,
                       const PlanNext& plan_next, const IterationObserver& observer = {});

}  // namespace enfilade
