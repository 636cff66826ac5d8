// The scene in what the program that reads IFC answers (reader/read_ifc.cjs).
#pragma once

#include <string>

#include "import/intake/import_options.hpp"
#include "scene/scene.hpp"

namespace enfilade {

/// Makes the scene of the model `path` from the program's answer, a JSON text. Throws InputError of
/// the model where the answer refuses it, holds no shape, or is not what the program should write.
Scene scene_from_ifc_answer(const std::string& answer, const std::string& path,
                            const ImportOptions& options, Warnings& warnings);

}  // namespace enfilade
