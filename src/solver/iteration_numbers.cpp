// Plans and summaries as plain numbers, for the token's second tour and the manifest.
#include <algorithm>

#include "base/number_reader.hpp"
#include "solver/iteration_plan.hpp"

namespace enfilade {

std::vector<double> to_numbers(const IterationPlan& plan) {
  std::vector<double> numbers = {static_cast<double>(plan.iteration),
                                 plan.link_tolerance,
                                 plan.refine ? 1.0 : 0.0,
                                 plan.renew_far ? 1.0 : 0.0,
                                 plan.close_rows ? 1.0 : 0.0,
                                 static_cast<double>(plan.openness_rays.rings),
                                 plan.openness_rays.per_cluster,
                                 plan.sample ? 1.0 : 0.0,
                                 static_cast<double>(plan.sample_rays),
                                 plan.received_power,
                                 plan.relaxation,
                                 plan.extrapolation,
                                 plan.finished ? 1.0 : 0.0,
                                 plan.converged ? 1.0 : 0.0,
                                 static_cast<double>(plan.flux_correction.size())};
  numbers.insert(numbers.end(), plan.flux_correction.begin(), plan.flux_correction.end());
  return numbers;
}

namespace {

IterationPlan next_plan_of(NumberReader& n) {
  IterationPlan plan;
  plan.iteration = static_cast<int>(n.next());
  plan.link_tolerance = n.next();
  plan.refine = n.next() != 0.0;
  plan.renew_far = n.next() != 0.0;
  plan.close_rows = n.next() != 0.0;
  plan.openness_rays.rings = static_cast<int>(n.next());
  plan.openness_rays.per_cluster = n.next();
  plan.sample = n.next() != 0.0;
  plan.sample_rays = static_cast<int>(n.next());
  plan.received_power = n.next();
  plan.relaxation = n.next();
  plan.extrapolation = n.next();
  plan.finished = n.next() != 0.0;
  plan.converged = n.next() != 0.0;
  for (std::uint64_t bands = n.next_count(); bands > 0; --bands)
    plan.flux_correction.push_back(n.next());
  return plan;
}

}  // namespace

IterationPlan plan_from(std::span<const double> numbers) {
  NumberReader n(numbers);
  return next_plan_of(n);
}

std::vector<double> to_numbers(const IterationSummary& summary) {
  std::vector<double> numbers = to_numbers(summary.plan);
  numbers.push_back(summary.corrected ? 1.0 : 0.0);
  numbers.push_back(summary.correction_failed ? 1.0 : 0.0);
  numbers.push_back(summary.missing_power);
  numbers.push_back(summary.error.discretisation);
  numbers.push_back(summary.error.visibility);
  numbers.push_back(summary.error.iteration);
  numbers.push_back(summary.error.patches);
  numbers.push_back(summary.error.iteration_bound);
  numbers.push_back(summary.time_s);
  const FoldedNumbers figures = to_numbers(summary.figures);
  numbers.insert(numbers.end(), figures.maxima.begin(), figures.maxima.end());
  numbers.insert(numbers.end(), figures.sums.begin(), figures.sums.end());
  return numbers;
}

IterationSummary summary_from(std::span<const double> numbers) {
  IterationSummary summary;
  NumberReader n(numbers);
  summary.plan = next_plan_of(n);
  summary.corrected = n.next() != 0.0;
  summary.correction_failed = n.next() != 0.0;
  summary.missing_power = n.next();
  summary.error.discretisation = n.next();
  summary.error.visibility = n.next();
  summary.error.iteration = n.next();
  summary.error.patches = n.next();
  summary.error.iteration_bound = n.next();
  summary.time_s = n.next();
  const std::size_t maxima = to_numbers(IterationFigures{}).maxima.size();
  summary.figures = figures_from(n.rest().first(std::min(maxima, n.rest().size())),
                                 n.rest().subspan(std::min(maxima, n.rest().size())));
  return summary;
}

}  // namespace enfilade
