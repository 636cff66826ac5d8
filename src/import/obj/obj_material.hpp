// Materials of an OBJ model: MTL libraries.
#pragma once

#include <map>

#include "import/intake/mesh_surfaces.hpp"
#include "json/model_files.hpp"

namespace enfilade {

/// Reads a library into `materials`, by name. Kd times the mean of its texture is the reflectance;
/// Ke, a luminance in cd/m2, makes an exitance of pi Ke; what passes more than half of the light
/// (d, Tr) is open. Throws InputError that names the line.
void read_obj_materials(const std::string& path, ModelFiles& files, const ModelFiles::Place& place,
                        Warnings& warnings, std::map<std::string, ModelMaterial>& materials);

}  // namespace enfilade
