#include "gather/emitted_power.hpp"

namespace enfilade {

Spectrum emitted_power(const Scene& scene, std::span<const Cluster> clusters) {
  Spectrum power(static_cast<std::size_t>(scene.bands), 0.0);
  for (const Cluster& c : clusters) {
    for (const ClusterPolygon& p : c.polygons) {
      const double area = area_m2(p.polygon);
      const Spectrum& exitance = scene.surfaces[p.surface.index()].exitance;
      for (std::size_t b = 0; b < power.size(); ++b) power[b] += area * exitance[b];
    }
  }
  for (const LightSource& light : scene.lights) {
    for (std::size_t b = 0; b < power.size(); ++b) {
      power[b] += sent_per_intensity(light) * light.intensity[b];
    }
  }
  return power;
}

}  // namespace enfilade
