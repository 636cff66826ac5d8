#include "parallel/spmd.hpp"

#include "parallel/ring.hpp"
#include "parallel/stealing.hpp"

namespace enfilade {
namespace {

/// Gathers for this rank's clusters, then for others' as long as there are any.
IterationSums gather_all(ClusterWork& work, TaskList& tasks, Dialogue& dialogue, Thief& thief,
                         bool steal) {
  IterationSums sums;
  while (const auto cluster = tasks.next()) {
    add(sums, work.gather(*cluster));
    dialogue.look();
  }
  while (steal) {
    const auto cluster = thief.request(work.resident());
    if (!cluster) break;
    tasks.adopt(*cluster);
    add(sums, work.gather(*cluster));
    dialogue.look();
  }
  sums.steals = thief.steals();
  sums.steal_requests = thief.requests();
  return sums;
}

}  // namespace

IterationPlan run_spmd(ClusterWork& work, TaskList& tasks, Communicator& communicator,
                       Machine& machine, const SpmdConfig& config, IterationPlan plan,
                       std::vector<double> changes, std::vector<IterationSummary>& history,
                       const PlanNext& plan_next, const SummaryObserver& observer) {
  Dialogue dialogue(communicator, machine, tasks);
  Thief thief(communicator, machine, dialogue);
  const double start_s = machine.now_s();

  const auto decide = [&](const Token& token) {  // on rank 0, when every rank is idle and has moved
    IterationSummary summary;
    summary.plan = plan;
    summary.sums = sums_from(token);
    summary.time_s = machine.now_s() - start_s;
    const Correction correction =
        config.coarse_correction ? work.correct(token.coarse) : Correction{};
    summary.missing_power = correction.missing_power;
    history.push_back(summary);
    const IterationPlan next = plan_next(history);
    work.commit(history, correction.changes, next.finished);
    if (observer) observer(history.back());
    return Verdict{next.finished ? -1.0 : history.back().sums.max_change, to_numbers(next),
                   correction.changes};
  };
  const auto add_own = [&work, &config](Token& token, const Token& own) {
    fold(token, own);
    if (config.coarse_correction) token.coarse = work.merge(token.coarse, own.coarse);
  };

  while (!plan.finished) {
    work.begin(plan, changes);
    tasks.start();
    thief.start(plan.iteration);
    dialogue.start(plan.iteration);
    const IterationSums sums = gather_all(work, tasks, dialogue, thief, config.steal);
    work.move_to_common();
    Token own = to_token(sums);
    if (config.coarse_correction) own.coarse = work.coarse();
    Verdict verdict = go_round(communicator, machine, dialogue, own, decide, add_own);
    plan = plan_from(verdict.plan);
    changes = std::move(verdict.correction);
  }
  return plan;
}

}  // namespace enfilade
