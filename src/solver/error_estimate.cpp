#include "solver/error_estimate.hpp"

#include <algorithm>
#include <cmath>

#include "final_gather/point_gather.hpp"
#include "solver/energy_conservation.hpp"

namespace enfilade {
namespace {

/// Share of the summed link errors that is taken as the local error before the first samples:
/// errors of links have either sign and mostly cancel where they meet.
constexpr double share_before_sampling = 0.25;
/// Share of the patches' local errors that remains where a point gathers over many of them.
constexpr double share_seen_together = 1.0 / 3.0;
/// Share of the sampling noise below which an error cannot be distinguished from zero.
constexpr double share_hidden_by_noise = 0.1;
/// Mean absolute value of a normally distributed error over its standard deviation, rounded.
constexpr double mean_over_standard_error = 0.8;
/// Where next to nothing is absorbed, an error of all light is not multiplied by more than 1 over
/// this: the balance of the light tells it better there.
constexpr double least_kept = 0.1;
/// A sum over points is off by more than so many standard deviations once in twenty times.
constexpr double deviations_by_chance = 2.0;

/// Returns the reflected share of band b's arriving power.
double reflected_share(const IterationFigures& figures, std::size_t b) {
  return figures.arriving_power[b] > 0.0
             ? std::clamp(figures.returning_power[b] / figures.arriving_power[b], 0.0, 1.0)
             : 0.0;
}

double worst(std::size_t bands, auto&& of_band) {
  double most = 0.0;
  for (std::size_t b = 0; b < bands; ++b) most = std::max(most, of_band(b));
  return most;
}

const IterationSummary* last_sampled(std::span<const IterationSummary> history) {
  for (std::size_t i = history.size(); i-- > 0;) {
    if (history[i].plan.sample) return &history[i];
  }
  return nullptr;
}

/// Returns the relative L1 difference of the patches' irradiance from the error samples, without
/// the sampling noise, which adds to it in quadrature.
double residual(const ErrorSampleSums& sums, std::size_t b) {
  if (b >= sums.light.size() || sums.light[b] <= 0.0) return 0.0;
  const double noise = sums.noise[b], square = sums.off[b] * sums.off[b] - noise * noise;
  const double seen = std::sqrt(std::max(0.0, square));
  return std::hypot(seen, share_hidden_by_noise * noise) / sums.light[b];
}

/// Returns the relative error that all points have in common: the patches as a whole are too dark
/// or too bright, by more than what points at random differ by.
double shared_residual(const ErrorSampleSums& sums, std::size_t b) {
  if (b >= sums.surplus_variance.size() || sums.light[b] <= 0.0) return 0.0;
  const double by_chance = deviations_by_chance * std::sqrt(sums.surplus_variance[b]);
  return std::max(0.0, std::abs(sums.surplus[b]) - by_chance) / sums.light[b];
}

/// Returns the relative noise of one sampled point in band b, mean over the points.
double sample_noise(const ErrorSampleSums& sums, std::size_t b) {
  return b < sums.light.size() && sums.light[b] > 0.0 ? sums.noise[b] / sums.light[b] : 0.0;
}

/// Returns the relative noise of a final gather at a point. Stratified rays reduce it a little
/// faster than by the square root of their number. A noisy point gets more rays, until its noise is
/// below least_noise() or it has had 16 times as many.
double gather_noise(const IterationSummary* sampled, double patch_error, std::size_t b) {
  if (sampled == nullptr) return 0.0;
  PointGatherConfig config;
  config.patch_error = patch_error;
  const double fewer = sampled->plan.sample_rays / static_cast<double>(config.rays_in_set());
  const double noise = sample_noise(sampled->figures.error_samples, b) * std::pow(fewer, 0.6);
  return std::min(noise, std::max(mean_over_standard_error * config.least_noise(), 0.25 * noise));
}

/// Returns the sum of the links' estimated errors over that of the last sampling, relative to the
/// light.
double finer_since(const IterationSummary& sampled, const IterationFigures& last) {
  const double now = share_of_received(last.link_error_power, last.received_power);
  const double then =
      share_of_received(sampled.figures.link_error_power, sampled.figures.received_power);
  return then > 0.0 ? now / then : 1.0;
}

/// Returns the local error of the patches in band b.
double local_error(std::span<const IterationSummary> history, std::size_t b) {
  const IterationFigures& last = history.back().figures;
  const IterationSummary* sampled = last_sampled(history);
  if (sampled == nullptr)
    return share_before_sampling * share_of_received(last.link_error_power, last.received_power);
  return residual(sampled->figures.error_samples, b) * finer_since(*sampled, last);
}

/// Returns the part of it that does not cancel where a point gathers over many patches. What is
/// lacking everywhere is reflected again and again, and lacks each time.
double shared_error(std::span<const IterationSummary> history, std::size_t b) {
  const IterationSummary* sampled = last_sampled(history);
  if (sampled == nullptr) return 0.0;
  const double kept = 1.0 - reflected_share(sampled->figures, b);
  return shared_residual(sampled->figures.error_samples, b) *
         finer_since(*sampled, history.back().figures) / std::max(kept, least_kept);
}

/// True where the last iteration tightened no tolerance, and used the row closure and the flux
/// correction of the one before: only then is the ratio of their changes an estimate of the
/// contraction factor.
bool comparable(const IterationSummary& last, const IterationSummary& before) {
  return last.plan.link_tolerance >= before.plan.link_tolerance &&
         last.plan.close_rows == before.plan.close_rows &&
         last.plan.flux_correction == before.plan.flux_correction;
}

double ratio(const IterationSummary& last, const IterationSummary& before) {
  const double change = before.figures.change_power;
  return change > 0.0 ? last.figures.change_power / change : 0.0;
}

/// Returns the ratio of the last two changes; the reflected share of the light where row closure or
/// flux correction changed between them.
double change_ratio(std::span<const IterationSummary> history) {
  if (history.size() < 2) return 0.0;
  const IterationSummary& last = history.back();
  const IterationSummary& before = history[history.size() - 2];
  return std::min(comparable(last, before) ? ratio(last, before) : most_reflected(last.figures),
                  0.9999);
}

/// Returns the largest of the last three ratios of changes over the same links, as geometric means
/// of two consecutive ratios where possible, since ratios may alternate; 0 where there are fewer.
double steady_ratio(std::span<const IterationSummary> history) {
  struct Step {
    std::size_t at;
    double ratio;
  };
  std::vector<Step> steps;  // the last one first
  for (std::size_t i = history.size(); i-- > 1 && steps.size() < 3;) {
    if (!few_links_refined(history[i]) || !few_links_refined(history[i - 1])) break;
    if (comparable(history[i], history[i - 1]))
      steps.push_back({i, ratio(history[i], history[i - 1])});
  }
  if (steps.size() < 3) return 0.0;
  const bool pair[2] = {steps[0].at == steps[1].at + 1, steps[1].at == steps[2].at + 1};
  double most = steps[0].ratio < 1.0 || !pair[0] ? steps[0].ratio : 0.0;
  for (std::size_t k = 0; k < 2; ++k) {
    if (pair[k]) most = std::max(most, std::sqrt(steps[k].ratio * steps[k + 1].ratio));
  }
  if (!pair[0] && !pair[1]) most = std::max(most, steps[1].ratio);
  if (!pair[1]) most = std::max(most, steps[2].ratio);
  return std::min(most, 0.9999);
}

/// Returns the relative L1 sum of the changes to come, where each is `passed_on` times the one
/// before: the gathers' changes, and the coarse correction's, which counts at least once in full.
double still_to_come(const IterationSummary& last, double passed_on) {
  const double series = passed_on / (1.0 - passed_on);
  return share_of_received(
      series * last.figures.change_power + std::max(1.0, series) * last.missing_power,
      last.figures.received_power);
}

}  // namespace

double most_reflected(const IterationFigures& figures) {
  return worst(figures.arriving_power.size(),
               [&](std::size_t b) { return reflected_share(figures, b); });
}

double contraction(std::span<const IterationSummary> history) {
  if (history.empty()) return 0.0;
  const double steady = steady_ratio(history);
  if (history.back().corrected && steady > 0.0) return steady;
  return std::min(std::max(most_reflected(history.back().figures), change_ratio(history)), 0.9999);
}

double reflected_error(const IterationSummary& last) {
  const double reflected = most_reflected(last.figures);
  return reflected > 0.0 ? last.error.total() / (mean_over_standard_error * reflected) : 0.0;
}

double sample_noise(const ErrorSampleSums& sums) {
  return worst(sums.light.size(), [&](std::size_t b) { return sample_noise(sums, b); });
}

ErrorEstimate estimate_error(std::span<const IterationSummary> history,
                             const SurfacesPower& surfaces) {
  ErrorEstimate estimate;
  if (history.empty()) {
    estimate.iteration = estimate.patches = estimate.iteration_bound = 1.0;
    return estimate;
  }
  const IterationSummary& last = history.back();
  const IterationFigures& figures = last.figures;
  estimate.iteration = still_to_come(last, change_ratio(history));
  estimate.iteration_bound = still_to_come(last, contraction(history));
  const bool still = estimate.iteration_bound < 0.01;  // else light to come unbalances it
  const auto all_over = [&](std::size_t b) {
    return still ? std::max(0.0,
                            std::abs(unbalanced_share(figures, surfaces, b)) - estimate.iteration)
                 : 0.0;
  };
  const std::size_t bands = std::min(surfaces.bands.size(), figures.absorbed_power.size());
  const auto seen_by_points = [&](std::size_t b) {
    return reflected_share(figures, b) *
           std::hypot(share_seen_together * local_error(history, b),
                      std::max(shared_error(history, b), all_over(b)));
  };
  estimate.patches = estimate.iteration + worst(bands, [&](std::size_t b) {
                       return std::hypot(local_error(history, b), all_over(b)) + seen_by_points(b);
                     });
  const double links = worst(bands, [&](std::size_t b) {
    return std::hypot(seen_by_points(b), gather_noise(last_sampled(history), estimate.patches, b));
  });
  const double uncertainty = figures.link_error_power > 0.0
                                 ? figures.visibility_uncertainty_power / figures.link_error_power
                                 : 0.0;
  estimate.visibility = uncertainty * links;
  estimate.discretisation = links - estimate.visibility;
  return estimate;
}

}  // namespace enfilade
