// glTF 2.0 models, as text or binary, with their extensions.
#pragma once

#include "import/intake/import_options.hpp"
#include "scene/scene.hpp"

namespace enfilade {

/// Reads the triangles and lamps of the default scene of a .gltf or .glb file: metres and y up
/// unless the options tell otherwise, three bands, lm/m2. An extension that the file requires and
/// that is not read is refused; what else is not carried out is in the warnings. Throws InputError
/// that names the key.
Scene import_gltf(const std::string& path, const ImportOptions& options, Warnings& warnings);

}  // namespace enfilade
