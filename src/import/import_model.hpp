// Models of other programs as scenes.
#pragma once

#include <string>
#include <vector>

#include "base/warnings.hpp"
#include "import/intake/import_options.hpp"
#include "scene/scene.hpp"

namespace enfilade {

/// Imports a .gltf, .glb, .obj, .ifc or .rad model; several files, one after the other, where
/// they are Radiance's. The reader runs in a process of its own with limits on memory and time.
/// Throws InputError, also where the reader crashes.
Scene import_model(const std::vector<std::string>& paths, const ImportOptions& options,
                   Warnings& warnings);
/// The same for one file, read as its format has it.
Scene import_model(const std::string& path, Warnings& warnings);

/// Reads a scene file, or any model that import_model() takes, by the file's extension.
/// `allow_outside`: files that it names may lie outside its own folder.
Scene read_scene_or_model(const std::string& path, Warnings& warnings, bool allow_outside = false);

}  // namespace enfilade
