#include "app/outputs/daylight_factor.hpp"

#include "base/error.hpp"
#include "scene/daylight.hpp"
#include "scene/equal_bands.hpp"

namespace enfilade {

void add_daylight_factors(const std::string& run, const Scene& scene,
                          std::vector<ProbeAnswer>& answers) {
  const LightOutside found = light_outside(scene);
  if (found.horizontal.empty())
    throw InputError(run, "--daylight-factor", found.obstacle, found.remedy);
  const Spectrum outside = in_bands_of_file(scene, found.horizontal);
  for (ProbeAnswer& answer : answers) {
    for (std::size_t b = 0; b < outside.size(); ++b) {
      answer.daylight_factor.push_back(outside[b] > 0.0 ? 100.0 * answer.irradiance[b] / outside[b]
                                                        : 0.0);
    }
  }
}

}  // namespace enfilade
