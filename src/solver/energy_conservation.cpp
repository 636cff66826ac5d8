#include "solver/energy_conservation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace enfilade {
namespace {

double sent_power(const IterationFigures& sums, const Spectrum& surfaces, std::size_t b) {
  return surfaces[b] + sums.direct_power[b];
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

double unbalanced_share(const IterationFigures& sums, const Spectrum& surfaces, std::size_t b) {
  const double sent = sent_power(sums, surfaces, b);
  if (sent <= 0.0) return 0.0;
  const double missing = sent - sums.absorbed_power[b];
  return (missing < 0.0 ? missing : std::max(0.0, missing - sums.escaping_power[b])) / sent;
}

Spectrum flux_correction(const IterationSummary& last, const Spectrum& surfaces, double tolerance) {
  const IterationFigures& sums = last.sums;
  Spectrum flux_correction = last.plan.flux_correction;
  if (!last.plan.close_rows) return flux_correction;
  for (std::size_t b = 0; b < std::min(surfaces.size(), sums.uncertain_power.size()); ++b) {
    const double share = unbalanced_share(sums, surfaces, b);
    const double lost = share * sent_power(sums, surfaces, b);
    if (std::abs(share) <= std::max(tolerance, 4.0 * last.error.iteration) ||
        sums.uncertain_power[b] <= 0.0) {
      continue;
    }
    flux_correction.resize(surfaces.size(), 0.0);
    flux_correction[b] = std::clamp(flux_correction[b] + lost / sums.uncertain_power[b], -1.0, 1.0);
  }
  return flux_correction;
}

}  // namespace enfilade
