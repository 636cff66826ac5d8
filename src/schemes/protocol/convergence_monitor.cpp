#include "schemes/protocol/convergence_monitor.hpp"

namespace enfilade {

ConvergenceMonitor::ConvergenceMonitor(ClusterWork& work, Machine& machine, bool coarse_correction,
                                       std::vector<IterationSummary>& history,
                                       const PlanNext& plan_next, const IterationObserver& observer)
    : work_(work),
      machine_(machine),
      coarse_correction_(coarse_correction),
      history_(history),
      plan_next_(plan_next),
      observer_(observer),
      start_s_(machine.now_s()) {}

Decision ConvergenceMonitor::decide(const IterationPlan& plan, const Token& token) {
  const Correction correction = coarse_correction_ ? work_.correct(token.coarse) : Correction{};
  history_.push_back(summary_of(plan, figures_from(token.maxima, token.sums),
                                coarse_correction_ ? &correction : nullptr,
                                machine_.now_s() - start_s_));
  const IterationPlan next = plan_next_(history_);
  work_.commit(history_, correction.changes, next.finished);
  if (observer_) observer_(history_.back());
  return {next.finished ? -1.0 : history_.back().figures.max_change, to_numbers(next),
          correction.changes, token.far_light};
}

Token own_token(const ClusterWork& work, const IterationFigures& figures, bool coarse_correction) {
  FoldedNumbers numbers = to_numbers(figures);
  Token own{std::move(numbers.maxima), std::move(numbers.sums), {}, work.far_light()};
  if (coarse_correction) own.coarse = work.coarse();
  return own;
}

void add_token(const ClusterWork& work, Token& token, const Token& own, bool coarse_correction) {
  fold(token, own);
  if (coarse_correction) token.coarse = work.merge(token.coarse, own.coarse);
  token.far_light.insert(token.far_light.end(), own.far_light.begin(), own.far_light.end());
}

}  // namespace enfilade
