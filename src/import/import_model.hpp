// Models of other programs as scenes.
#pragma once

#include <string>

#include "base/warnings.hpp"
#include "scene/scene.hpp"

namespace enfilade {

/// Imports .gltf, .glb, .obj or .ifc (through Assimp), or .rad (radiance_import.hpp). Emission
/// becomes exitance, base colour reflectance. Throws InputError.
Scene import_model(const std::string& path, Warnings& warnings);

/// Reads a scene file, or any model that import_model() takes, by the file's extension.
Scene read_scene_or_model(const std::string& path, Warnings& warnings);

}  // namespace enfilade
