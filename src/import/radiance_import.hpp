// Scene descriptions of Radiance, Ward's lighting simulation: geometry and diffuse light.
#pragma once

#include "scene/scene.hpp"

namespace enfilade {

/// Reads a .rad file and the files that it includes by plain !xform, in metres and W/m2, three
/// bands.
/// Surfaces reflect on both sides and emit from their front alone. Warns of all that is left out.
Scene import_radiance(const std::string& path, Warnings& warnings);

}  // namespace enfilade
