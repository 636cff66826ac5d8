// The schedule of link tolerances, and when to stop: pure functions of what the iterations brought.
#include "parallel/iteration_plan.hpp"

#include <algorithm>
#include <cmath>

namespace enfilade {
namespace {

/// The links' errors have either sign, and mostly cancel where they meet: against the exact answers
/// of closed scenes the light was off by a fifth (two rooms and a door) to a twentieth (an empty
/// room) of their sum.
constexpr double share_that_stays = 0.25;
/// How the sum of the links' errors falls with their tolerance, measured: about its cube root.
constexpr double tolerance_order = 3.0;

double first_epsilon(const PlanConfig& config) {
  return config.epsilon > 0.0 ? config.epsilon : 2.5e-3 * config.target_error;
}
double tolerance_of(const PlanConfig& config) {
  return config.tolerance > 0.0 ? config.tolerance : 0.02 * config.target_error;
}
double relative(double power, double received) {
  if (power == 0.0) return 0.0;
  return received > 0.0 ? power / received : 1.0;
}

}  // namespace

IterationPlan first_plan(const PlanConfig& config) {
  IterationPlan plan;
  plan.link_tolerance = first_epsilon(config) * config.emitted_power;
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
  // What the iterations to come would still add: a geometric series of the last change (the
  // difference of two iterations alone understates it where light dies away slowly). The coarse
  // correction takes care of the slow part, and tells how much that was.
  const double missing = history.back().missing_power;
  const double passed_on =
      missing > 0.0 ? std::min(contraction(history), 0.5) : contraction(history);
  const double to_come = last.change_power * passed_on / (1.0 - passed_on) + missing;
  return relative(share_that_stays * last.link_error_power + to_come, last.received_power);
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
  // Where little is absorbed, much more light arrives than is emitted, and the error is relative to
  // it.
  if (!settled && config.epsilon <= 0.0) {
    plan.link_tolerance =
        first_epsilon(config) *
        std::max(config.emitted_power, last.sums.received_power + last.missing_power);
  }
  // Refining again what was not touched last time finds nothing new, as long as the light hardly
  // changes.
  const bool few_refined = last.sums.work.links_refined * 1000 <= last.sums.links;
  plan.refine = !(settled && few_refined);
  const double still =
      relative(last.sums.change_power + last.missing_power, last.sums.received_power);
  const bool quiet = still <= tolerance_of(config) && last.plan.close_rows == plan.close_rows;
  const double links_error =
      relative(share_that_stays * last.sums.link_error_power, last.sums.received_power);
  const bool fine = config.epsilon > 0.0 || links_error <= 0.9 * config.target_error;
  // A finer tolerance that found nothing to refine will not find more when it is finer still.
  const bool finest = history.size() > 1 && last.sums.work.links_refined == 0 && last.plan.refine &&
                      last.plan.link_tolerance < history[history.size() - 2].plan.link_tolerance;
  if (settled && few_refined && !fine && !finest) {
    const double factor = std::pow(0.8 * config.target_error / links_error, tolerance_order);
    plan.link_tolerance *= std::clamp(factor, 1.0 / 32.0, 0.7);
    plan.refine = true;
  } else if (quiet && few_refined) {
    plan.finished = true;
    plan.converged = fine;
  } else if (last.plan.iteration >= config.max_iterations) {
    plan.finished = true;
  }
  return plan;
}

}  // namespace enfilade
