#include "bounds/iteration/energy_bounds.hpp"

#include <algorithm>

namespace enfilade {

namespace {

/// What a polygon absorbs of the light on its front, at least: a pane passes at most its
/// transmittance.
double kept_share(const BoundPolygon& polygon, std::size_t band) {
  const double passes = polygon.transmittance.empty() ? 0.0 : polygon.transmittance[band];
  return std::max(0.0, 1.0 - polygon.reflectance[band] - passes);
}

}  // namespace

EnergyBounds::EnergyBounds(const BoundScene& scene, std::vector<double> areas_m2, bool closed)
    : scene_(scene), areas_m2_(std::move(areas_m2)), closed_(closed), power_(scene.bands, 0.0) {
  for (std::size_t band = 0; band < scene.bands; ++band) {
    for (std::size_t k = 0; k < scene.polygons.size(); ++k)
      power_[band] += areas_m2_[k] * scene.polygons[k].exitance[band];
    for (const LightSource& light : scene.lights)
      power_[band] += power_per_intensity(light) * light.intensity[band];
  }
}

double EnergyBounds::absorbed(std::size_t polygon, std::size_t band) const {
  return areas_m2_[polygon] * kept_share(scene_.polygons[polygon], band);
}

void EnergyBounds::narrow(std::vector<std::vector<Range>>& polygons) const {
  for (std::size_t band = 0; band < scene_.bands; ++band) {
    double least = 0.0, most = 0.0;  // absorbed by all
    for (std::size_t k = 0; k < polygons.size(); ++k) {
      least += absorbed(k, band) * polygons[k][band].lo;
      most += absorbed(k, band) * polygons[k][band].hi;
    }
    for (std::size_t k = 0; k < polygons.size(); ++k) {
      const double share = absorbed(k, band);
      if (share <= 0.0) continue;
      Range& e = polygons[k][band];
      const Range old = e;
      e.hi = std::max(old.lo, std::min(old.hi, (power_[band] - least) / share + old.lo));
      if (closed_) e.lo = std::min(e.hi, std::max(old.lo, old.hi - (most - power_[band]) / share));
    }
  }
}

/// The most light that a set of polygons can have, times area, above its lower bounds: `spare`
/// power is left to be absorbed above the lower bounds of all polygons.
double EnergyBounds::most(std::span<const std::uint32_t> set, std::size_t band,
                          const std::vector<std::vector<Range>>& polygons, double spare) const {
  std::vector<std::uint32_t> order(set.begin(), set.end());
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return kept_share(scene_.polygons[a], band) < kept_share(scene_.polygons[b], band);
  });
  double sum = 0.0;
  for (const std::uint32_t k : order) {
    const double want = absorbed(k, band) * polygons[k][band].width();
    if (want <= 0.0) {  // takes nothing from the spare power
      sum += areas_m2_[k] * polygons[k][band].width();
      continue;
    }
    const double given = std::clamp(spare / want, 0.0, 1.0);
    sum += given * areas_m2_[k] * polygons[k][band].width();
    spare -= given * want;
  }
  return sum;
}

std::vector<std::vector<Range>> EnergyBounds::means(
    std::span<const std::vector<std::uint32_t>> sets,
    const std::vector<std::vector<Range>>& polygons) const {
  std::vector<std::vector<Range>> found;
  for (const auto& set : sets) {
    std::vector<Range>& ranges = found.emplace_back(scene_.bands);
    for (std::size_t band = 0; band < scene_.bands; ++band) {
      double least = 0.0, greatest = 0.0;  // absorbed by all polygons of the scene
      for (std::size_t k = 0; k < polygons.size(); ++k) {
        least += absorbed(k, band) * polygons[k][band].lo;
        greatest += absorbed(k, band) * polygons[k][band].hi;
      }
      double area = 0.0, lo = 0.0, hi = 0.0;
      for (const std::uint32_t k : set) {
        area += areas_m2_[k];
        lo += areas_m2_[k] * polygons[k][band].lo;
        hi += areas_m2_[k] * polygons[k][band].hi;
      }
      if (area <= 0.0) continue;
      Range& mean = ranges[band];
      mean.hi = (lo + most(set, band, polygons, std::max(0.0, power_[band] - least))) / area;
      mean.lo =
          closed_ ? (hi - most(set, band, polygons, std::max(0.0, greatest - power_[band]))) / area
                  : lo / area;
    }
  }
  return found;
}

}  // namespace enfilade
