// solution.glb: the lit building as a glTF binary that any viewer opens.
#pragma once

#include <string>

#include "report/pictures/solved_scene.hpp"
#include "report/pictures/tone_mapping.hpp"

namespace enfilade {

/// Returns the bytes of a glTF 2.0 binary: one node per object, leaf patches as triangles, vertex
/// colours = tone-mapped radiosity, KHR_materials_unlit. Positions are metres, y up. The attribute
/// _IRRADIANCE holds the irradiance at each vertex (mean of the bands) in the unit that
/// asset.extras names.
std::string solution_glb(const SolvedScene& solved, const ToneConfig& tone = {});

}  // namespace enfilade
