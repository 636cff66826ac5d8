#include <cmath>
#include <numbers>

#include "photometry/files/photometric_file.hpp"

namespace enfilade {
namespace {

/// The first angle from the aim at which half the intensity is left, in a half-plane.
double half_beam(const IntensityDistribution& distribution, double plane) {
  constexpr double step = 0.1;
  const double c = plane * std::numbers::pi / 180.0;
  const auto at = [&](double degrees) {
    const double gamma = degrees * std::numbers::pi / 180.0;
    return distribution.intensity(
        {std::sin(gamma) * std::cos(c), std::sin(gamma) * std::sin(c), std::cos(gamma)});
  };
  const double half = 0.5 * at(0.0);
  double bright = 0.0;
  while (bright < 180.0 && at(bright + step) >= half) bright += step;
  double dark = bright + step;
  for (int i = 0; i < 20; ++i) {
    const double middle = 0.5 * (bright + dark);
    (at(middle) >= half ? bright : dark) = middle;
  }
  return bright;
}

}  // namespace

PhotometricFigures figures_of(const IntensityDistribution& distribution) {
  PhotometricFigures figures;
  const IntensityTable& table = distribution.table();
  for (std::size_t p = 0; p < table.planes.size(); ++p) {
    for (std::size_t a = 0; a < table.angles.size(); ++a) {
      if (table.at(p, a) <= figures.peak_cd) continue;
      figures.peak_cd = table.at(p, a);
      figures.peak_plane = table.planes[p];
      figures.peak_angle = table.angles[a];
    }
  }
  if (distribution.intensity({0.0, 0.0, 1.0}) < 0.5 * figures.peak_cd) return figures;
  figures.beam_0 = half_beam(distribution, 0.0) + half_beam(distribution, 180.0);
  figures.beam_90 = half_beam(distribution, 90.0) + half_beam(distribution, 270.0);
  return figures;
}

}  // namespace enfilade
