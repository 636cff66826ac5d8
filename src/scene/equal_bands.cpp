#include "scene/equal_bands.hpp"

#include <algorithm>

namespace enfilade {
namespace {

bool are_alike(const Scene& scene, std::size_t a, std::size_t b) {
  const auto same = [a, b](const Spectrum& values) { return values[a] == values[b]; };
  return std::ranges::all_of(scene.surfaces,
                             [&](const Surface& s) {
                               return same(s.reflectance) && same(s.exitance) &&
                                      (!s.is_pane() || same(s.transmittance));
                             }) &&
         std::ranges::all_of(scene.lights,
                             [&](const LightSource& light) { return same(light.intensity); });
}

Spectrum pick(const Spectrum& values, std::span<const std::size_t> bands) {
  Spectrum picked;
  for (const std::size_t b : bands) picked.push_back(values[b]);
  return picked;
}

}  // namespace

void merge_equal_bands(Scene& scene) {
  if (!scene.band_of.empty()) return;  // the bands have been merged already
  const auto bands = static_cast<std::size_t>(scene.bands);
  std::vector<std::size_t> kept, band_of;
  for (std::size_t b = 0; b < bands; ++b) {
    const auto like =
        std::ranges::find_if(kept, [&](std::size_t k) { return are_alike(scene, k, b); });
    band_of.push_back(static_cast<std::size_t>(like - kept.begin()));
    if (like == kept.end()) kept.push_back(b);
  }
  if (kept.size() == bands) return;
  scene.band_of = std::move(band_of);
  scene.bands = static_cast<int>(kept.size());
  for (Surface& s : scene.surfaces) {
    s.reflectance = pick(s.reflectance, kept);
    s.exitance = pick(s.exitance, kept);
    if (s.is_pane()) s.transmittance = pick(s.transmittance, kept);
  }
  for (LightSource& light : scene.lights) light.intensity = pick(light.intensity, kept);
  if (!scene.sky) return;
  for (Spectrum* of_sky : {&scene.sky->zenith_luminance, &scene.sky->sun_illuminance,
                           &scene.sky->ground_reflectance}) {
    if (!of_sky->empty()) *of_sky = pick(*of_sky, kept);
  }
}

std::size_t bands_of_file(const Scene& scene) {
  return scene.band_of.empty() ? static_cast<std::size_t>(scene.bands) : scene.band_of.size();
}

Spectrum in_bands_of_file(const Scene& scene, std::span<const double> solved) {
  if (scene.band_of.empty()) return {solved.begin(), solved.end()};
  Spectrum all;
  for (const std::size_t b : scene.band_of) all.push_back(solved[b]);
  return all;
}

}  // namespace enfilade
