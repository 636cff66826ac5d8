// Photometric files for the lamps of a model, by the names of their types.
#pragma once

#include <string>

#include "base/warnings.hpp"
#include "scene/scene.hpp"

namespace enfilade {

struct LuminaireMatches {
  std::size_t lamps = 0, matched = 0;  ///< fixtures and lights that bear a name
  std::size_t files = 0;               ///< photometric files in the folder
};

/// Gives each fixture and each light whose type or name is that of a photometric file in the folder
/// (.ies, .ldt, in it or below) the distribution and the opening of that file. Case, and all signs
/// but letters and digits, do not count; where no file has the whole name of a type, a part of it
/// between colons will do ("Family:Type:1234"). A flux that the model tells scales the file's.
/// Warns of names without a file, and takes back from `warnings` that a matched lamp stays dark. A
/// faulty file is left out with a warning. Throws InputError for a folder that is not there or has
/// no such file, and where all files of a lamp's name are faulty.
LuminaireMatches match_luminaires(Scene& scene, const std::string& folder, Warnings& warnings);

}  // namespace enfilade
