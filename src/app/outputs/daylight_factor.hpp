// Daylight factors of points: their share of the light outside.
#pragma once

#include "scene_file/scene_io.hpp"

namespace enfilade {

/// Fills the daylight factors of the answers, percent: irradiance over light_outside(). Throws
/// InputError that names `run` where there is none.
void add_daylight_factors(const std::string& run, const Scene& scene,
                          std::vector<ProbeAnswer>& answers);

}  // namespace enfilade
