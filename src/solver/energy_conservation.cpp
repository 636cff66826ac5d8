#include "solver/energy_conservation.hpp"

#include <algorithm>
#include <cmath>

namespace enfilade {
namespace {

double sent_power(const IterationFigures& figures, const SurfacesPower& surfaces, std::size_t b) {
  return surfaces.bands[b] + figures.direct_power[b];
}

/// Power that the balance lacks; below zero: has too much. All that may escape counts as escaping,
/// but a correction of the last iteration is wanted only as far as the balance needs it. Panes take
/// in an amount that nobody sums up: with them, only what is too much is known.
double lost_power(const IterationFigures& figures, double sent, bool panes, double correction,
                  std::size_t b) {
  const double missing = sent - figures.absorbed_power[b];
  if (panes) return correction < 0.0 ? missing : std::min(0.0, missing);
  const double at_least = missing - figures.escaping_power[b];
  if (correction > 0.0) return at_least;
  if (correction < 0.0) return missing;
  return missing < 0.0 ? missing : std::max(0.0, at_least);
}

/// Share of the distance from the end that the lost power keeps in an iteration, where it is not
/// known; the most that is believed; and the share of a change by which what is foretold may be
/// off.
constexpr double first_kept = 0.5, most_kept = 0.75, change_in_doubt = 0.5;
/// Without the coarse correction: lost power that is told from light that still moves, over the
/// estimated iteration error.
constexpr double still_moving = 4.0;

double share_of(const IterationSummary& iteration, std::size_t b) {
  const Spectrum& shares = iteration.plan.flux_correction;
  return b < shares.size() ? shares[b] : 0.0;
}

/// The uncertain power after the coarse correction.
double uncertain_power(const IterationSummary& last, std::size_t b) {
  const double received = last.figures.received_power;
  const double more = received > 0.0 ? 1.0 + last.missing_power / received : 1.0;
  return last.figures.uncertain_power[b] * more;
}

struct Foretold {
  double power = 0.0, uncertainty = 0.0;
};

/// Returns the power that the balance will lack once the light rests, with the flux correction as
/// it is. In each iteration the lost power goes a part of the way to its end, which moves by the
/// uncertain power times each change of the correction; three iterations tell which part (Aitken).
Foretold lost_in_the_end(std::span<const IterationSummary> history, const SurfacesPower& surfaces,
                         std::size_t b) {
  const IterationSummary& last = history.back();
  const double before = share_of(last, b);
  const auto lost_at = [&](const IterationSummary& i) {
    return lost_power(i.figures, sent_power(i.figures, surfaces, b), surfaces.panes, before, b);
  };
  const double lost = lost_at(last);
  if (!last.corrected)
    return {lost, sent_power(last.figures, surfaces, b) * still_moving * last.error.iteration};
  const auto closed = [&](std::size_t back) {
    return history.size() > back && history[history.size() - 1 - back].plan.close_rows;
  };
  if (!closed(1)) return {};
  const IterationSummary& second = history[history.size() - 2];
  const double moved = uncertain_power(last, b) * (before - share_of(second, b));
  const double change = lost - lost_at(second);
  double kept = first_kept;
  if (closed(1) && closed(2)) {
    const double then = lost_at(second) - lost_at(history[history.size() - 3]) + moved;
    kept = then != 0.0 ? std::clamp((change + moved) / then, 0.0, most_kept) : 0.0;
  }
  return {lost + change * kept / (1.0 - kept), change_in_doubt * std::abs(change)};
}

}  // namespace

SurfacesPower surfaces_power(const Scene& scene, Spectrum emitted) {
  for (const LightSource& light : scene.lights) {
    for (std::size_t b = 0; b < emitted.size(); ++b) {
      emitted[b] = std::max(0.0, emitted[b] - sent_per_intensity(light) * light.intensity[b]);
    }
  }
  const auto is_pane = [](const Surface& surface) { return surface.is_pane(); };
  return {std::move(emitted), std::ranges::any_of(scene.surfaces, is_pane)};
}

double unbalanced_share(const IterationFigures& figures, const SurfacesPower& surfaces,
                        std::size_t b) {
  const double sent = sent_power(figures, surfaces, b);
  return sent > 0.0 ? lost_power(figures, sent, surfaces.panes, 0.0, b) / sent : 0.0;
}

Spectrum flux_correction(std::span<const IterationSummary> history, const SurfacesPower& surfaces,
                         double tolerance) {
  const IterationSummary& last = history.back();
  Spectrum flux_correction = last.plan.flux_correction;
  if (!last.plan.close_rows) return flux_correction;
  for (std::size_t b = 0; b < std::min(surfaces.bands.size(), last.figures.uncertain_power.size());
       ++b) {
    const double sent = sent_power(last.figures, surfaces, b), uncertain = uncertain_power(last, b);
    const double before = share_of(last, b);
    const Foretold lost = lost_in_the_end(history, surfaces, b);
    if (std::abs(lost.power) <= std::max(sent * tolerance, lost.uncertainty) || uncertain <= 0.0)
      continue;
    flux_correction.resize(surfaces.bands.size(), 0.0);
    // No more than is needed: a correction shrinks to zero before it changes its sign.
    const double most = before < 0.0 ? 0.0 : 1.0, least = before > 0.0 ? 0.0 : -1.0;
    flux_correction[b] = std::clamp(before + lost.power / uncertain, least, most);
  }
  return flux_correction;
}

}  // namespace enfilade
