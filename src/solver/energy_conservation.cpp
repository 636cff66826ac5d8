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

Spectrum flux_correction(const IterationSummary& last, const SurfacesPower& surfaces,
                         double tolerance) {
  const IterationFigures& figures = last.figures;
  Spectrum flux_correction = last.plan.flux_correction;
  if (!last.plan.close_rows) return flux_correction;
  for (std::size_t b = 0; b < std::min(surfaces.bands.size(), figures.uncertain_power.size());
       ++b) {
    const double sent = sent_power(figures, surfaces, b), uncertain = figures.uncertain_power[b];
    const double before = b < flux_correction.size() ? flux_correction[b] : 0.0;
    const double lost = lost_power(figures, sent, surfaces.panes, before, b);
    if (std::abs(lost) <= sent * std::max(tolerance, 4.0 * last.error.iteration) ||
        uncertain <= 0.0) {
      continue;
    }
    flux_correction.resize(surfaces.bands.size(), 0.0);
    // No more than is needed: a correction shrinks to zero before it changes its sign.
    const double most = before < 0.0 ? 0.0 : 1.0, least = before > 0.0 ? 0.0 : -1.0;
    flux_correction[b] = std::clamp(before + lost / uncertain, least, most);
  }
  return flux_correction;
}

}  // namespace enfilade
