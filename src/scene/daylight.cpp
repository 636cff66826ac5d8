#include "scene/daylight.hpp"

namespace enfilade {
namespace {

bool gives(const Spectrum& light) {
  return std::ranges::any_of(light, [](double b) { return b > 0.0; });
}

/// True for the sky's own dome: that of the ground is about the nadir.
bool is_sky(const Scene& scene, const LightSource& light) {
  return light.sky != nullptr && glm::dot(light.sky->zenith, scene.sky->zenith) > 0.0;
}

}  // namespace

LightOutside light_outside(const Scene& scene) {
  if (!scene.sky) return {{}, "the scene has no sky", "give it a \"sky\", as in the README"};
  if (gives(scene.sky->sun_illuminance))
    return {{}, "the scene has sunlight", "leave out the sun's \"illuminance\""};
  LightOutside outside;
  bool lamps = std::ranges::any_of(scene.surfaces, &Surface::emits);
  for (const LightSource& light : scene.lights) {
    if (!gives(light.intensity)) continue;
    if (!light.is_far()) {
      lamps = true;
    } else if (is_sky(scene, light)) {
      const double per_intensity =
          light.luminance_per_intensity * scene.sky->horizontal_per_zenith();
      for (const double i : light.intensity) outside.horizontal.push_back(per_intensity * i);
    }
  }
  if (lamps) {
    return {{},
            "the scene has lamps",
            "solve it without their light, or with --shares and turn them off by --switch"};
  }
  if (outside.horizontal.empty())
    return {{}, "the sky gives no light", "give it a brightness, or leave its --switch out"};
  return outside;
}

}  // namespace enfilade
