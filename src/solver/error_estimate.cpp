#include "solver/error_estimate.hpp"

#include <algorithm>
#include <cmath>

#include "final_gather/point_gather.hpp"
#include "solver/energy_conservation.hpp"

namespace enfilade {
namespace {

/// Before the first samples: errors of links have either sign, and mostly cancel where they meet.
constexpr double share_before_sampling = 0.25;
/// What is left of the patches' local errors where a point gathers over many of them.
constexpr double share_seen_together = 1.0 / 3.0;
/// An error below this share of the sampling's noise cannot be told from none.
constexpr double share_hidden_by_noise = 0.1;
/// Of a normal error.
constexpr double mean_over_standard_error = 0.8;

double relative(double power, double received) {
  if (power == 0.0) return 0.0;
  return received > 0.0 ? power / received : 1.0;
}

/// Share of band b's arriving light that was reflected.
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

/// Relative L1 residual of the patches' irradiance. Noise adds to it in quadrature.
double residual(const ErrorSampleSums& sums, std::size_t b) {
  if (b >= sums.light.size() || sums.light[b] <= 0.0) return 0.0;
  const double noise = sums.noise[b], square = sums.off[b] * sums.off[b] - noise * noise;
  const double seen = std::sqrt(std::max(0.0, square));
  return std::hypot(seen, share_hidden_by_noise * noise) / sums.light[b];
}

/// Relative noise of one sampled point in band b, mean over the points.
double sample_noise(const ErrorSampleSums& sums, std::size_t b) {
  return b < sums.light.size() && sums.light[b] > 0.0 ? sums.noise[b] / sums.light[b] : 0.0;
}

/// The rays of a gathered point bring noise of their own, which falls a little faster than by the
/// square root as they are stratified. A noisy point gets more of them, until it is noisy no more
/// or has had 16 times as many.
double gather_noise(const IterationSummary* sampled, double patch_error, std::size_t b) {
  if (sampled == nullptr) return 0.0;
  PointGatherConfig config;
  config.patch_error = patch_error;
  const double fewer = sampled->plan.sample_rays / static_cast<double>(config.rays);
  const double noise = sample_noise(sampled->figures.error_samples, b) * std::pow(fewer, 0.6);
  return std::min(noise, std::max(mean_over_standard_error * config.least_noise(), 0.25 * noise));
}

/// The patches' own error in band b.
double local_error(std::span<const IterationSummary> history, std::size_t b) {
  const IterationFigures& last = history.back().figures;
  const double now = relative(last.link_error_power, last.received_power);
  const IterationSummary* sampled = last_sampled(history);
  if (sampled == nullptr) return share_before_sampling * now;
  const double then = relative(sampled->figures.link_error_power, sampled->figures.received_power);
  return residual(sampled->figures.error_samples, b) * (then > 0.0 ? now / then : 1.0);
}

double most_reflected(const IterationFigures& figures) {
  return worst(figures.arriving_power.size(),
               [&](std::size_t b) { return reflected_share(figures, b); });
}

/// The same links, closed and mended alike: only then does one change tell of the one before.
bool comparable(const IterationSummary& last, const IterationSummary& before) {
  return last.plan.close_rows == before.plan.close_rows &&
         last.plan.flux_correction == before.plan.flux_correction;
}

double ratio(const IterationSummary& last, const IterationSummary& before) {
  const double change = before.figures.change_power;
  return change > 0.0 ? last.figures.change_power / change : 0.0;
}

/// The last two changes. One that rows being closed or light being mended has made is passed on as
/// light is reflected.
double change_ratio(std::span<const IterationSummary> history) {
  if (history.size() < 2) return 0.0;
  const IterationSummary& last = history.back();
  const IterationSummary& before = history[history.size() - 2];
  return std::min(comparable(last, before) ? ratio(last, before) : most_reflected(last.figures),
                  0.9999);
}

/// The largest that the last three ratios of changes over the same links show, two by two where
/// they follow each other, for they may alternate; 0 where there are fewer.
double steady_ratio(std::span<const IterationSummary> history) {
  struct Step {
    std::size_t at;
    double ratio;
  };
  std::vector<Step> steps;  // the last one first
  for (std::size_t i = history.size(); i-- > 1 && steps.size() < 3;) {
    if (history[i].figures.work.links_refined + history[i - 1].figures.work.links_refined > 0)
      break;
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

/// Relative L1 of the changes to come, where each is `passed_on` times the one before: gathers' and
/// the coarse system's, which is never taken for better than it was this time.
double still_to_come(const IterationSummary& last, double passed_on) {
  const double series = passed_on / (1.0 - passed_on);
  return relative(series * last.figures.change_power + std::max(1.0, series) * last.missing_power,
                  last.figures.received_power);
}

}  // namespace

double contraction(std::span<const IterationSummary> history) {
  if (history.empty()) return 0.0;
  const double steady = steady_ratio(history);
  if (history.back().corrected && steady > 0.0) return steady;
  return std::min(std::max(most_reflected(history.back().figures), change_ratio(history)), 0.9999);
}

double sample_noise(const ErrorSampleSums& sums) {
  return worst(sums.light.size(), [&](std::size_t b) { return sample_noise(sums, b); });
}

ErrorEstimate estimate_error(std::span<const IterationSummary> history, const Spectrum& surfaces) {
  ErrorEstimate estimate;
  if (history.empty()) {
    estimate.iteration = estimate.patches = estimate.iteration_bound = 1.0;
    return estimate;
  }
  const IterationSummary& last = history.back();
  const IterationFigures& figures = last.figures;
  estimate.iteration = still_to_come(last, change_ratio(history));
  estimate.iteration_bound = still_to_come(last, contraction(history));
  const bool still = estimate.iteration_bound < 0.01;  // else the balance tells of light to come
  const auto all_over = [&](std::size_t b) {
    return still ? std::max(0.0,
                            std::abs(unbalanced_share(figures, surfaces, b)) - estimate.iteration)
                 : 0.0;
  };
  const std::size_t bands = std::min(surfaces.size(), figures.absorbed_power.size());
  const auto seen_by_points = [&](std::size_t b) {
    return reflected_share(figures, b) *
           std::hypot(share_seen_together * local_error(history, b), all_over(b));
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
