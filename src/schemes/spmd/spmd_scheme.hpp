// The paper's scheme as a ParallelScheme: every rank reads and writes the clusters' files, goes
// through its own CYCLE, and steals (§3.2, §3.3.3).
#pragma once

#include <functional>

#include "schemes/protocol/parallel_scheme.hpp"
#include "schemes/spmd/spmd.hpp"

namespace enfilade {

class SpmdScheme final : public ParallelScheme {
 public:
  /// `make_tasks` makes this rank's CYCLE, once the iterations begin. `files`, `communicator` and
  /// `machine` must outlive the scheme.
  SpmdScheme(ClusterFiles& files, std::function<TaskList()> make_tasks, Communicator& communicator,
             Machine& machine, const SpmdConfig& config)
      : files_(files),
        make_tasks_(std::move(make_tasks)),
        communicator_(communicator),
        machine_(machine),
        config_(config) {}

  ClusterFiles& files() override { return files_; }
  bool gathers_for_its_own() const override { return true; }
  IterationPlan run(RadiosityWork& work, const IterationPlan& plan,
                    const std::vector<double>& changes, std::vector<IterationSummary>& history,
                    const PlanNext& plan_next, const IterationObserver& observer) override {
    TaskList tasks = make_tasks_();
    work.set_next_use([&tasks](ClusterId id, bool links) { return tasks.next_use(id, links); });
    return run_spmd(work, tasks, communicator_, machine_, config_, plan, changes, history,
                    plan_next, observer);
  }

 private:
  ClusterFiles& files_;
  std::function<TaskList()> make_tasks_;
  Communicator& communicator_;
  Machine& machine_;
  SpmdConfig config_;
};

}  // namespace enfilade
