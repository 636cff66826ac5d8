// The tone map of a whole building, alike from every place in it.
#pragma once

#include "report/pictures/solved_scene.hpp"
#include "report/pictures/tone_mapping.hpp"

namespace enfilade {

/// Exposure and white are found from the radiosities of all leaf patches, weighted by area.
ToneMap scene_tone_map(const SolvedScene& solved, const ToneConfig& config = {});

}  // namespace enfilade
