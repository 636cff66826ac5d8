#include "schemes/protocol/convergence_monitor.hpp"

namespace enfilade {

ConvergenceMonitor::ConvergenceMonitor(ClusterWork& work, Machine& machine, bool coarse_correction,
                                       std::vector<IterationSummary>& history,
                                       const PlanNext& plan_next, const SummaryObserver& observer)
    : work_(work),
      machine_(machine),
      coarse_correction_(coarse_correction),
      history_(history),
      plan_next_(plan_next),
      observer_(observer),
      start_s_(machine.now_s()) {}

Decision ConvergenceMonitor::decide(const IterationPlan& plan, const Token& token) {
  IterationSummary summary;
  summary.plan = plan;
  summary.sums = figures_from(token.maxima, token.sums);
  summary.time_s = machine_.now_s() - start_s_;
  const Correction correction = coarse_correction_ ? work_.correct(token.coarse) : Correction{};
  summary.corrected = coarse_correction_ && !correction.failed;
  summary.correction_failed = correction.failed;
  summary.missing_power = correction.missing_power;
  for (std::size_t b = 0; b < correction.absorbed_power.size(); ++b) {
    summary.sums.absorbed_power[b] += correction.absorbed_power[b];
    summary.sums.escaping_power[b] += correction.escaping_power[b];
  }
  history_.push_back(summary);
  const IterationPlan next = plan_next_(history_);
  work_.commit(history_, correction.changes, next.finished);
  if (observer_) observer_(history_.back());
  return {next.finished ? -1.0 : history_.back().sums.max_change, to_numbers(next),
          correction.changes};
}

Token own_token(const ClusterWork& work, const IterationFigures& figures, bool coarse_correction) {
  FoldedNumbers numbers = to_numbers(figures);
  Token own{std::move(numbers.maxima), std::move(numbers.sums), {}};
  if (coarse_correction) own.coarse = work.coarse();
  return own;
}

void add_token(const ClusterWork& work, Token& token, const Token& own, bool coarse_correction) {
  fold(token, own);
  if (coarse_correction) token.coarse = work.merge(token.coarse, own.coarse);
}

}  // namespace enfilade
