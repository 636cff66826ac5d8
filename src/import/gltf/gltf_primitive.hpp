// The triangles of one primitive of a mesh.
#pragma once

#include <array>
#include <optional>

#include "base/warnings.hpp"
#include "geometry/polygon.hpp"
#include "import/gltf/gltf_document.hpp"

namespace enfilade {

struct GltfPrimitive {
  std::vector<Vec3> points;
  std::vector<std::array<double, 3>> colours;  ///< of the points, linear; none or one each
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::optional<std::size_t> material;
};

/// Reads triangles, strips and fans, plain or compressed by Draco. Warns of points and lines, which
/// are left out, and of morph targets.
GltfPrimitive read_primitive(GltfDocument& document, const nlohmann::json& primitive,
                             const std::string& where, Warnings& warnings);

}  // namespace enfilade
