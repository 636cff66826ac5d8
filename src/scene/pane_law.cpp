#include "scene/pane_law.hpp"

#include <algorithm>
#include <cmath>

namespace enfilade {
namespace {

constexpr double refractive_index = 1.52;  ///< of window glass

/// Of a slab without absorption, for one polarization: r is the reflectance of one face.
double through_slab(double amplitude) {
  const double r = amplitude * amplitude;
  return (1.0 - r) / (1.0 + r);
}

double clear_pane(double cosine) {
  const double within =
      std::sqrt(1.0 - (1.0 - cosine * cosine) / (refractive_index * refractive_index));
  const double across = (cosine - refractive_index * within) / (cosine + refractive_index * within);
  const double along = (refractive_index * cosine - within) / (refractive_index * cosine + within);
  return 0.5 * (through_slab(across) + through_slab(along));
}

}  // namespace

double clear_pane_transmittance() {
  static const double normal = clear_pane(1.0);
  return normal;
}

double pane_share(double cosine) {
  const double c = std::abs(cosine);
  return c > 0.0 ? clear_pane(std::min(c, 1.0)) / clear_pane_transmittance() : 0.0;
}

}  // namespace enfilade
