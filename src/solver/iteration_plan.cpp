// The schedule of link tolerances, and when to stop: pure functions of what the iterations brought.
#include "solver/iteration_plan.hpp"

#include <algorithm>
#include <cmath>

#include "solver/energy_conservation.hpp"

namespace enfilade {
namespace {

/// How the sum of the links' errors falls with their tolerance, measured: about its cube root.
constexpr double tolerance_order = 3.0;

double first_epsilon(const PlanConfig& config) {
  return config.epsilon > 0.0 ? config.epsilon : 2.5e-3 * config.target_error;
}
double tolerance_of(const PlanConfig& config) {
  return config.tolerance > 0.0 ? config.tolerance : 0.02 * config.target_error;
}
double worst_band(const Spectrum& power) {
  return power.empty() ? 0.0 : *std::max_element(power.begin(), power.end());
}
double relative(double power, double received) {
  if (power == 0.0) return 0.0;
  return received > 0.0 ? power / received : 1.0;
}

/// What noise there is gets measured; it only must not drown the asked error.
int rays_of_a_sample(const PlanConfig& config) {
  return static_cast<int>(std::clamp(4.0 / config.target_error, 64.0, 1024.0));
}

/// The links that there are now have been sampled.
bool sampled(std::span<const IterationSummary> history) {
  for (std::size_t i = history.size(); i-- > 0;) {
    if (history[i].plan.sample) return true;
    if (history[i].figures.work.links_refined > 0) return false;
  }
  return false;
}

/// A finer tolerance that found nothing to refine will not find more when it is finer still.
bool nothing_finer(std::span<const IterationSummary> history) {
  const IterationSummary* finer = nullptr;  // the last refining one
  for (std::size_t i = history.size(); i-- > 0;) {
    if (!history[i].plan.refine) continue;
    if (finer == nullptr) {
      finer = &history[i];
      if (finer->figures.work.links_refined > 0) return false;
    } else {
      return finer->plan.link_tolerance < history[i].plan.link_tolerance;
    }
  }
  return false;
}

/// What the links are wrong by. What is gathered from the patches shall be as good as asked, and
/// what is read off them too (`patches`), where that does not take too many links.
double links_error(const ErrorEstimate& error, bool patches) {
  return std::max(patches ? error.patches : 0.0, error.total()) - error.iteration;
}

/// Much finer links brought the error down by less than half as fast as they should have: what is
/// wrong does not come from the links.
bool no_better(std::span<const IterationSummary> history, bool patches) {
  const IterationSummary& now = history.back();
  for (std::size_t i = history.size() - 1; i-- > 0;) {
    const IterationSummary& then = history[i];
    const double finer = now.plan.link_tolerance / then.plan.link_tolerance;
    if (!then.plan.sample || !(finer <= 1.0 / 8.0)) continue;
    return links_error(now.error, patches) >
           std::pow(finer, 0.5 / tolerance_order) * links_error(then.error, patches);
  }
  return false;
}

}  // namespace

IterationPlan first_plan(const PlanConfig& config) {
  IterationPlan plan;
  plan.link_tolerance = first_epsilon(config) * worst_band(config.emitted_power);
  return plan;
}

IterationPlan next_plan(std::span<const IterationSummary> history, const PlanConfig& config) {
  if (history.empty()) return first_plan(config);
  const IterationSummary& last = history.back();
  IterationPlan plan = last.plan;
  plan.iteration = last.plan.iteration + 1;
  plan.finished = plan.converged = plan.sample = false;
  plan.received_power = last.figures.received_power;
  // Light has been everywhere once the change falls below what arrives.
  const double change = relative(last.figures.change_power, last.figures.received_power);
  const bool settled = change < 0.1;
  // Once closed they stay so: closing moves the light as well, and opening them again would move it
  // back for ever.
  plan.close_rows = settled || last.plan.close_rows;
  // Where little is absorbed, much more light arrives than is emitted, and the error is relative to
  // it.
  if (!settled && config.epsilon <= 0.0) {
    plan.link_tolerance =
        first_epsilon(config) * std::max(worst_band(config.emitted_power),
                                         last.figures.received_power + last.missing_power);
  }
  // Refining again what was not touched last time finds nothing new, as long as the light hardly
  // changes.
  const bool few_refined = last.figures.work.links_refined * 1000 <= last.figures.links;
  const bool links_done = settled && few_refined && last.plan.close_rows == plan.close_rows;
  plan.refine = !(settled && few_refined);
  plan.flux_correction = flux_correction(last, config.surfaces_power, 0.02 * config.target_error);
  const bool all_done = links_done && plan.flux_correction == last.plan.flux_correction;
  const bool quiet = all_done && last.error.iteration_bound <= tolerance_of(config);
  // What the links are wrong by shows before the light has come to rest.
  const bool calm = all_done && last.error.iteration_bound <=
                                    std::max(tolerance_of(config), 0.02 * config.target_error);
  const bool patches = (config.patch_links == 0 || last.figures.links <= config.patch_links) &&
                       !no_better(history, true);
  const double error = links_error(last.error, patches);
  const bool fine = error <= 0.9 * config.target_error;
  const bool out_of_iterations = last.plan.iteration >= config.max_iterations;
  if (out_of_iterations) {
    plan.finished = true;
    plan.converged = quiet && fine && sampled(history);
  } else if (calm && !sampled(history)) {
    plan.sample = true;
    plan.sample_rays = rays_of_a_sample(config);
  } else if (quiet && !fine && config.epsilon <= 0.0 && !nothing_finer(history) &&
             !no_better(history, false)) {
    const double factor = std::pow(0.8 * config.target_error / error, tolerance_order);
    plan.link_tolerance *= std::clamp(factor, 1.0 / 32.0, 0.7);
    plan.refine = true;
  } else if (quiet) {
    plan.finished = true;
    plan.converged = error <= config.target_error || config.epsilon > 0.0;
  }
  return plan;
}

}  // namespace enfilade
