// Wavefront OBJ models with their MTL materials.
#pragma once

#include "import/intake/import_options.hpp"
#include "scene/scene.hpp"

namespace enfilade {

/// Reads the polygons of a .obj file: metres and y up unless the options tell otherwise, three
/// bands, lm/m2. Throws InputError; warns of what is left out and of what is missing.
Scene import_obj(const std::string& path, const ImportOptions& options, Warnings& warnings);

}  // namespace enfilade
