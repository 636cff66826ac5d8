// Daylight factors of points: their share of the light outside.
#pragma once

#include "scene_file/scene_io.hpp"

namespace enfilade {

/// Fills the daylight factors of the answers, percent: irradiance over that of an unobstructed
/// horizontal plane under the scene's sky, sunlight left out (CIE S 017). Throws InputError that
/// names `run` where the scene has no sky, or light besides it.
void add_daylight_factors(const std::string& run, const Scene& scene,
                          std::vector<ProbeAnswer>& answers);

}  // namespace enfilade
