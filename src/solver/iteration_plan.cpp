// The schedule of link tolerances and the end of a solve: a state machine that is a pure function
// of the summaries so far.
#include "solver/iteration_plan.hpp"

#include <algorithm>
#include <cmath>

#include "solver/energy_conservation.hpp"
#include "solver/extrapolation.hpp"

namespace enfilade {
namespace {

double worst_band(const Spectrum& power) {
  return power.empty() ? 0.0 : *std::max_element(power.begin(), power.end());
}

double first_epsilon(const PlanConfig& config) {
  const PlanWeights& w = config.weights;
  const double coarser = config.at_points ? w.first_at_points : 1.0;
  const double parts =
      std::max(1.0, static_cast<double>(config.clusters) / w.clusters_at_first_epsilon);
  return config.epsilon > 0.0 ? config.epsilon
                              : coarser * w.first_epsilon_share * config.target_error / parts;
}

/// Returns the bound of the changes by later iterations below which iterations end.
double iteration_tolerance(const PlanConfig& config) {
  return config.tolerance > 0.0 ? config.tolerance
                                : config.weights.iteration_share * config.target_error;
}

int rays_of_a_sample(const PlanConfig& config) {
  const PlanWeights& w = config.weights;
  return static_cast<int>(std::clamp(w.sample_rays_times_target / config.target_error,
                                     w.least_sample_rays, w.most_sample_rays));
}

/// The share that n stratified rays find has a standard deviation of at most 0.5 n^(-3/4). For a
/// leaf it comes to 0.3 of a large target error; a small one is left to the gain that the deficits
/// of open rows have.
OpennessRays openness_rays(double target_error) {
  const double of_leaf = std::pow(0.5 / (0.3 * target_error), 4.0 / 3.0);
  OpennessRays rays;
  rays.rings = static_cast<int>(std::lround(std::clamp(std::sqrt(0.25 * of_leaf), 2.0, 4.0)));
  rays.per_cluster = std::clamp(10.0 / target_error, 64.0, 512.0);
  return rays;
}

OpennessRays more_of(const OpennessRays& a, const OpennessRays& b) {
  return {std::max(a.rings, b.rings), std::max(a.per_cluster, b.per_cluster)};
}

/// True where errors were sampled after the last iteration that refined a link.
bool links_were_sampled(std::span<const IterationSummary> history) {
  for (std::size_t i = history.size(); i-- > 0;) {
    if (history[i].plan.sample) return true;
    if (history[i].figures.work.links_refined > 0) return false;
  }
  return false;
}

/// True where the last refining iteration had a finer tolerance than the one before and refined no
/// link: a still finer tolerance would refine none either.
bool nothing_left_to_refine(std::span<const IterationSummary> history) {
  const IterationSummary* last_refining = nullptr;
  for (std::size_t i = history.size(); i-- > 0;) {
    if (!history[i].plan.refine) continue;
    if (last_refining == nullptr) {
      last_refining = &history[i];
      if (last_refining->figures.work.links_refined > 0) return false;
    } else {
      return last_refining->plan.link_tolerance < history[i].plan.link_tolerance;
    }
  }
  return false;
}

/// Returns the links' part of the error of final-gathered light or, with `with_patches`, of the
/// patches' light where that is larger.
double links_error(const ErrorEstimate& error, bool with_patches) {
  return std::max(with_patches ? error.patches : 0.0, error.total()) - error.iteration;
}

/// True where much finer links reduced the error less than half as fast as their order predicts,
/// and at that rate much finer links once more would not reach the target: the rest of the error
/// does not come from the links.
bool refinement_stagnates(std::span<const IterationSummary> history, bool with_patches,
                          const PlanConfig& config) {
  const PlanWeights& w = config.weights;
  const IterationSummary& now = history.back();
  for (std::size_t i = history.size() - 1; i-- > 0;) {
    const IterationSummary& then = history[i];
    const double finer = now.plan.link_tolerance / then.plan.link_tolerance;
    if (!then.plan.sample || !(finer <= w.much_finer)) continue;
    const double error = links_error(now.error, with_patches);
    const double remaining = error / links_error(then.error, with_patches);
    if (remaining <= std::pow(finer, w.stagnation_share / w.tolerance_order)) return false;
    if (remaining >= 1.0) return true;
    const double order = std::log(remaining) / std::log(finer);
    return w.fine_share * config.target_error < error * std::pow(w.much_finer, order);
  }
  return false;
}

/// What the last iteration shows: the conditions of the transitions.
struct Observation {
  bool light_is_everywhere = false;  ///< the change is small relative to the received power
  bool few_links_refined = false;
  bool rows_as_before = false;        ///< row closure did not begin just now
  bool correction_as_before = false;  ///< the flux correction did not change just now
  bool links_rest() const {
    return light_is_everywhere && few_links_refined && rows_as_before && correction_as_before;
  }
  bool iterations_converged = false;
  bool good_enough_to_sample = false;  ///< the iterations have converged enough to sample errors
  double links_error = 0.0;
};

/// The states of a solve, each named after what its next iteration does.
enum class State {
  distribute,         ///< light is not fully distributed: refine, and scale the tolerance with it
  refine_links,       ///< refine links at the present tolerance and light
  converge,           ///< links are stable; light, row closure and flux correction converge
  sample_errors,      ///< sample the error at points
  tighten_tolerance,  ///< links are too coarse for the target error: refine with a finer tolerance
  finish,
  give_up,  ///< out of iterations
};

State next_state(std::span<const IterationSummary> history, const Observation& seen,
                 const PlanConfig& config) {
  const PlanWeights& w = config.weights;
  if (history.back().plan.iteration >= config.max_iterations) return State::give_up;
  if (seen.links_rest() && seen.good_enough_to_sample && !links_were_sampled(history))
    return State::sample_errors;
  if (seen.links_rest() && seen.iterations_converged) {
    const bool too_coarse = seen.links_error > w.fine_share * config.target_error;
    const bool can_be_finer = config.epsilon <= 0.0 && !nothing_left_to_refine(history) &&
                              !refinement_stagnates(history, false, config);
    return too_coarse && can_be_finer ? State::tighten_tolerance : State::finish;
  }
  if (!seen.light_is_everywhere) return State::distribute;
  return seen.few_links_refined ? State::converge : State::refine_links;
}

/// Returns the factor of the tolerance at which there would be patch_links links; 0 = no limit.
double factor_to_patch_links(const IterationSummary& last, const PlanConfig& config) {
  if (config.patch_links == 0) return 0.0;
  return std::pow(static_cast<double>(last.figures.links) / static_cast<double>(config.patch_links),
                  config.weights.link_order);
}

/// Returns the next finer tolerance: the error falls with a power of the tolerance, and the step is
/// bounded both ways.
double tightened(const IterationSummary& last, double error, const PlanConfig& config) {
  const PlanWeights& w = config.weights;
  double factor = std::pow(w.aim_share * config.target_error / error, w.tolerance_order);
  const bool for_patches_alone =
      links_error(last.error, false) <= w.fine_share * config.target_error;
  if (for_patches_alone) factor = std::max(factor, factor_to_patch_links(last, config));
  return last.plan.link_tolerance * std::clamp(factor, w.most_tightening, w.least_tightening);
}

Observation observe(std::span<const IterationSummary> history, const IterationPlan& plan,
                    const PlanConfig& config) {
  const PlanWeights& w = config.weights;
  const IterationSummary& last = history.back();
  Observation seen;
  seen.light_is_everywhere =
      share_of_received(last.figures.change_power, last.figures.received_power) < w.settled_change;
  seen.few_links_refined = few_links_refined(last, w.links_per_refined);
  seen.rows_as_before = last.plan.close_rows == plan.close_rows;
  seen.correction_as_before = last.plan.flux_correction == plan.flux_correction;
  const double bound = last.error.iteration_bound;
  seen.iterations_converged = bound <= iteration_tolerance(config);
  // The links' error can be measured before the iterations have converged.
  seen.good_enough_to_sample =
      bound <= std::max(iteration_tolerance(config), w.iteration_share * config.target_error);
  const bool hold_patches = factor_to_patch_links(last, config) <= w.least_tightening &&
                            !refinement_stagnates(history, true, config);
  seen.links_error = links_error(last.error, hold_patches);
  return seen;
}

}  // namespace

bool few_links_refined(const IterationSummary& iteration, double per) {
  return static_cast<double>(iteration.figures.work.links_refined) * per <=
         static_cast<double>(iteration.figures.links);
}

IterationPlan first_plan(const PlanConfig& config) {
  IterationPlan plan;
  plan.link_tolerance = first_epsilon(config) * worst_band(config.emitted_power);
  plan.openness_rays = openness_rays(config.target_error);
  return plan;
}

IterationPlan next_plan(std::span<const IterationSummary> history, const PlanConfig& config) {
  if (history.empty()) return first_plan(config);
  const IterationSummary& last = history.back();
  IterationPlan plan = last.plan;
  plan.iteration = last.plan.iteration + 1;
  plan.finished = plan.converged = plan.sample = plan.renew_far = false;
  plan.openness_rays = more_of(last.plan.openness_rays, openness_rays(config.target_error));
  plan.received_power = last.figures.received_power;
  const bool light_is_everywhere =
      share_of_received(last.figures.change_power, last.figures.received_power) <
      config.weights.settled_change;
  // Once closed, rows stay closed: closure changes the light, and leaving it out again would change
  // the light back, without end.
  plan.close_rows = light_is_everywhere || last.plan.close_rows;
  plan.flux_correction = flux_correction(history, config.surfaces_power,
                                         config.weights.iteration_share * config.target_error);
  const Observation seen = observe(history, plan, config);
  // Where little is absorbed, much more power arrives than is emitted, and errors are relative to
  // the arriving power. Once errors have been sampled, they tell how fine links must be.
  const bool sampled = std::any_of(history.begin(), history.end(),
                                   [](const IterationSummary& i) { return i.plan.sample; });
  // Links that the last iteration did not refine stay within the tolerance, as the light hardly
  // changes.
  plan.refine = !(seen.light_is_everywhere && seen.few_links_refined);
  if (plan.refine && !sampled && config.epsilon <= 0.0) {
    const double received = std::max(worst_band(config.emitted_power),
                                     last.figures.received_power + last.missing_power);
    const double wanted = first_epsilon(config) * received;
    const bool outgrown = wanted > config.weights.outgrown * plan.link_tolerance;
    if (outgrown || !seen.light_is_everywhere) plan.link_tolerance = wanted;
  }
  switch (next_state(history, seen, config)) {
    case State::distribute:
      plan.renew_far = true;
      break;
    case State::refine_links:
    case State::converge:
      break;
    case State::sample_errors:
      plan.sample = true;
      plan.sample_rays = rays_of_a_sample(config);
      break;
    case State::tighten_tolerance:
      plan.link_tolerance = tightened(last, seen.links_error, config);
      plan.refine = plan.renew_far = true;
      break;
    case State::finish:
      plan.finished = true;
      plan.converged = seen.links_error <= config.target_error || config.epsilon > 0.0;
      break;
    case State::give_up:
      plan.finished = true;
      plan.converged = seen.links_rest() && seen.iterations_converged &&
                       seen.links_error <= config.weights.fine_share * config.target_error &&
                       links_were_sampled(history);
      break;
  }
  plan.extrapolation = extrapolation_of(plan, history);
  return plan;
}

}  // namespace enfilade
