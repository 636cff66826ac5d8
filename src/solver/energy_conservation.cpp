#include "solver/energy_conservation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace enfilade {
namespace {

double sent_power(const IterationFigures& figures, const Spectrum& surfaces, std::size_t b) {
  return surfaces[b] + figures.direct_power[b];
}

}  // namespace

Spectrum surfaces_power(const Scene& scene, Spectrum emitted) {
  for (const PointLight& light : scene.lights) {
    for (std::size_t b = 0; b < emitted.size(); ++b) {
      emitted[b] = std::max(0.0, emitted[b] - 4.0 * std::numbers::pi * light.intensity[b]);
    }
  }
  return emitted;
}

double unbalanced_share(const IterationFigures& figures, const Spectrum& surfaces, std::size_t b) {
  const double sent = sent_power(figures, surfaces, b);
  if (sent <= 0.0) return 0.0;
  const double missing = sent - figures.absorbed_power[b];
  return (missing < 0.0 ? missing : std::max(0.0, missing - figures.escaping_power[b])) / sent;
}

Spectrum flux_correction(const IterationSummary& last, const Spectrum& surfaces, double tolerance) {
  const IterationFigures& figures = last.figures;
  Spectrum flux_correction = last.plan.flux_correction;
  if (!last.plan.close_rows) return flux_correction;
  for (std::size_t b = 0; b < std::min(surfaces.size(), figures.uncertain_power.size()); ++b) {
    const double share = unbalanced_share(figures, surfaces, b);
    const double lost = share * sent_power(figures, surfaces, b);
    if (std::abs(share) <= std::max(tolerance, 4.0 * last.error.iteration) ||
        figures.uncertain_power[b] <= 0.0) {
      continue;
    }
    flux_correction.resize(surfaces.size(), 0.0);
    flux_correction[b] =
        std::clamp(flux_correction[b] + lost / figures.uncertain_power[b], -1.0, 1.0);
  }
  return flux_correction;
}

}  // namespace enfilade
