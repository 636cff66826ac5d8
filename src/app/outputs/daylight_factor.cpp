#include "app/outputs/daylight_factor.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "scene/equal_bands.hpp"

namespace enfilade {

void add_daylight_factors(const std::string& run, const Scene& scene,
                          std::vector<ProbeAnswer>& answers) {
  const auto refuse = [&](const std::string& what, const std::string& hint) {
    throw InputError(run, "--daylight-factor", what, hint);
  };
  const auto gives = [](const Spectrum& light) {
    return std::ranges::any_of(light, [](double b) { return b > 0.0; });
  };
  if (!scene.sky) refuse("the scene has no sky", "give it a \"sky\", as in the README");
  if (gives(scene.sky->sun_illuminance))
    refuse("the scene has sunlight", "leave out the sun's \"illuminance\"");
  const auto is_lamp = [&](const LightSource& light) { return !light.is_far(); };
  const auto emits = [&](const Surface& surface) { return gives(surface.exitance); };
  if (std::ranges::any_of(scene.lights, is_lamp) || std::ranges::any_of(scene.surfaces, emits))
    refuse("the scene has lamps", "solve it without their light");
  const Spectrum outside = in_bands_of_file(scene, scene.sky->horizontal(false));
  for (ProbeAnswer& answer : answers) {
    for (std::size_t b = 0; b < outside.size(); ++b) {
      answer.daylight_factor.push_back(outside[b] > 0.0 ? 100.0 * answer.irradiance[b] / outside[b]
                                                        : 0.0);
    }
  }
}

}  // namespace enfilade
