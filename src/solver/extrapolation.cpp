#include "solver/extrapolation.hpp"

#include <algorithm>
#include <cmath>

#include "solver/error_estimate.hpp"

namespace enfilade {
namespace {

/// Returns the contraction factor without extrapolation of an error that `extrapolation` has made
/// shrink by `ratio`: the root z = ratio of z^2 - w m z + w - 1 = 0 for m. Errors below
/// sqrt(w - 1) oscillate at that rate and tell nothing.
double without_extrapolation(double ratio, double extrapolation) {
  const double w = std::max(1.0, extrapolation);
  return ratio * ratio > w - 1.0 ? (ratio * ratio + w - 1.0) / (w * ratio) : 0.0;
}

/// Returns the ratio of changes in the last of three iterations in a row, by the geometric mean of
/// two, since ratios may alternate.
double mean_ratio(const IterationSummary& first, const IterationSummary& last) {
  const double change = first.figures.change_power;
  return change > 0.0 ? std::sqrt(last.figures.change_power / change) : 0.0;
}

/// True where the light, extrapolated as far as ever, keeps moving as much as before: in a gap that
/// hardly any light enters, a leaf's light may leap to and fro between the limits of what is
/// extrapolated. Or where that was so since links were refined last.
bool never_rests(std::span<const IterationSummary> history, const ExtrapolationWeights& weights) {
  std::size_t first = history.size();
  while (first > 0 && !history[first - 1].plan.refine) --first;
  std::size_t alike = 0;  // extrapolated iterations in a row, with one flux correction
  for (std::size_t i = first; i < history.size(); ++i) {
    const IterationPlan& plan = history[i].plan;
    if (plan.extrapolation >= 1.0) {
      if (i > first && plan.flux_correction != history[i - 1].plan.flux_correction) alike = 0;
      ++alike;
    } else if (alike > 0) {
      if (history[i - 1].corrected) return true;
      alike = 0;  // the coarse correction had failed
    }
  }
  if (alike <= weights.patience) return false;
  const IterationSummary &last = history.back(),
                         &then = history[history.size() - 1 - weights.patience];
  return then.plan.extrapolation >= last.plan.extrapolation &&
         last.figures.change_power > weights.no_rest * then.figures.change_power;
}

}  // namespace

double extrapolation_of(const IterationPlan& plan, std::span<const IterationSummary> history,
                        const ExtrapolationWeights& weights) {
  if (plan.refine || history.empty() || !history.back().corrected) return 0.0;
  if (never_rests(history, weights)) return 0.0;
  if (history.back().plan.extrapolation < 1.0) return 1.0;
  double factor = weights.first_share * most_reflected(history.back().figures);
  for (std::size_t i = history.size(); i-- > 2;) {
    const IterationPlan &now = history[i].plan, &then = history[i - 2].plan;
    const Spectrum& between = history[i - 1].plan.flux_correction;
    if (then.extrapolation < 1.0) break;
    // What moves the light besides is no contraction.
    if (now.flux_correction != between || between != then.flux_correction) continue;
    factor = std::max(
        factor, without_extrapolation(mean_ratio(history[i - 2], history[i]), now.extrapolation));
  }
  factor = std::min(factor, weights.most);
  return 2.0 / (1.0 + std::sqrt(1.0 - factor * factor));
}

}  // namespace enfilade
