// The one glTF extension that the importer library does not read.
#pragma once

#include <string>
#include <vector>

namespace enfilade {

/// KHR_materials_emissive_strength of each material of a .gltf or .glb file, 1 where there is none;
/// empty where the bytes are no glTF.
std::vector<double> emissive_strengths(const std::string& bytes);

}  // namespace enfilade
