// Scene descriptions of Radiance, Ward's lighting simulation: geometry and diffuse light.
#pragma once

#include "import/intake/import_options.hpp"
#include "scene/scene.hpp"

namespace enfilade {

/// Reads .rad files, one after the other as one model, and the files that they take in by
/// commands: in metres and z up unless the options tell otherwise, in W/m2, three bands. Surfaces
/// reflect on both sides and emit from their front alone. Warns of all that is left out.
Scene import_radiance(const std::vector<std::string>& paths, const ImportOptions& options,
                      Warnings& warnings);

}  // namespace enfilade
