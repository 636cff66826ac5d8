// The schedule of link tolerances, and when to stop: pure functions of what the iterations brought.
#include "parallel/iteration_plan.hpp"

#include <algorithm>
#include <cmath>

namespace enfilade {
namespace {

double epsilon_of(const PlanConfig& config) {
  return config.epsilon > 0.0 ? config.epsilon : 1e-3 * config.target_error;
}
double tolerance_of(const PlanConfig& config) {
  return config.tolerance > 0.0 ? config.tolerance : 0.1 * config.target_error;
}
double relative(double power, double received) {
  if (power == 0.0) return 0.0;
  return received > 0.0 ? power / received : 1.0;
}

}  // namespace

IterationPlan first_plan(const PlanConfig& config) {
  IterationPlan plan;
  plan.link_tolerance = epsilon_of(config) * config.emitted_power;
  return plan;
}

double contraction(std::span<const IterationSummary> history) {
  if (history.size() < 2) return 0.0;
  const double before = history[history.size() - 2].sums.change_power;
  const double now = history.back().sums.change_power;
  return before > 0.0 ? std::min(now / before, 0.9999) : 0.0;
}

double estimate_error(std::span<const IterationSummary> history) {
  if (history.empty()) return 1.0;
  const IterationSums& last = history.back().sums;
  // What the iterations to come would still add: a geometric series of the last change. The difference of two
  // iterations alone understates it where light dies away slowly.
  const double passed_on = contraction(history);
  const double to_come =
      std::max(last.change_power * passed_on / (1.0 - passed_on), history.back().missing_power);
  return relative(last.link_error_power + to_come, last.received_power);
}

IterationPlan next_plan(std::span<const IterationSummary> history, const PlanConfig& config) {
  if (history.empty()) return first_plan(config);
  const IterationSummary& last = history.back();
  IterationPlan plan = last.plan;
  plan.iteration = last.plan.iteration + 1;
  plan.finished = plan.converged = false;
  // Light has been everywhere once the change falls below what arrives.
  const double change = relative(last.sums.change_power, last.sums.received_power);
  const bool settled = change < 0.1;
  plan.close_rows = settled;
  plan.link_tolerance = epsilon_of(config) * config.emitted_power;
  // Refining again what was not touched last time finds nothing new, as long as the light hardly changes.
  const bool few_refined = last.sums.work.links_refined * 1000 <= last.sums.links;
  plan.refine = !(settled && few_refined);
  const bool quiet = change <= tolerance_of(config) && last.plan.close_rows == plan.close_rows;
  if (quiet && few_refined) {
    plan.finished = plan.converged = true;
  } else if (last.plan.iteration >= config.max_iterations) {
    plan.finished = true;
  }
  return plan;
}

}  // namespace enfilade
