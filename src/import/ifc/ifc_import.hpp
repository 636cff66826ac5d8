// IFC models (2x3, 4 and 4.3), by web-ifc.
#pragma once

#include "import/intake/import_options.hpp"
#include "scene/scene.hpp"

namespace enfilade {

/// Reads the shapes of an .ifc file, with what it says about rooms, doors, windows and lamps:
/// three bands, lm/m2. A lamp whose flux is told becomes a point light. web-ifc runs under Node.js
/// as a program of its own. Throws InputError, also where Node.js or web-ifc is not installed.
Scene import_ifc(const std::string& path, const ImportOptions& options, Warnings& warnings);

}  // namespace enfilade
