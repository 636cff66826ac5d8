// Points files: the input of `locate`.
#pragma once

#include <string>
#include <vector>

#include "base/geometry.hpp"

namespace enfilade {

/// Points in metres from {"points": [[x,y,z] or {"p": [x,y,z]}, ...]}, {"probes": [{"p": ...},
/// ...]} or the bare list. Throws InputError that names the key.
std::vector<Vec3> read_points(const std::string& path);

}  // namespace enfilade
