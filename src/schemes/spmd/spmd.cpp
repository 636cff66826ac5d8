#include "schemes/spmd/spmd.hpp"

#include "schemes/spmd/ring.hpp"
#include "schemes/spmd/work_stealing.hpp"

namespace enfilade {
namespace {

/// Gathers for this rank's clusters, then for stolen ones until no rank has any left.
IterationFigures gather_all(ClusterWork& work, TaskList& tasks, ProgressEngine& engine,
                            WorkStealingClient& thief, bool steal) {
  IterationFigures figures;
  const auto gather = [&](ClusterId cluster) {
    const IterationFigures part = work.gather(cluster);
    tasks.gathered(cluster, part.change_power);
    add(figures, part);
    engine.progress();
  };
  while (const auto cluster = tasks.next()) gather(*cluster);
  while (steal) {
    const auto cluster = thief.request(work.resident());
    if (!cluster) break;
    tasks.adopt(*cluster);
    gather(*cluster);
  }
  figures.steals = thief.steals();
  figures.steal_requests = thief.requests();
  return figures;
}

}  // namespace

IterationPlan run_spmd(ClusterWork& work, TaskList& tasks, Communicator& communicator,
                       Machine& machine, const SpmdConfig& config, IterationPlan plan,
                       std::vector<double> changes, std::vector<IterationSummary>& history,
                       const PlanNext& plan_next, const IterationObserver& observer) {
  ProgressEngine engine(communicator, machine, tasks);
  WorkStealingClient thief(communicator, machine, engine);
  ConvergenceMonitor monitor(work, machine, config.coarse_correction, history, plan_next, observer);
  const auto decide = [&](const Token& token) { return monitor.decide(plan, token); };
  const auto add_own = [&](Token& token, const Token& own) {
    add_token(work, token, own, config.coarse_correction);
  };

  if (communicator.size() > 1) work.set_listener([&engine] { engine.progress_if_due(); });
  while (!plan.finished) {
    work.begin(plan, changes);
    tasks.start();
    thief.start(plan.iteration);
    engine.start(plan.iteration);
    const IterationFigures figures = gather_all(work, tasks, engine, thief, config.steal);
    work.move_to_common();
    const Token own = own_token(work, figures, config.coarse_correction);
    Decision decision = go_round(communicator, machine, engine, own, decide, add_own);
    plan = plan_from(decision.plan);
    changes = std::move(decision.correction);
    work.take_far_light(decision.far_light);
  }
  work.set_listener({});
  return plan;
}

}  // namespace enfilade
