// Meshes that are compressed by Draco.
#pragma once

#include "import/gltf/gltf_accessor.hpp"

namespace enfilade {

struct DracoMesh {
  GltfValues points, colours;          ///< colours: none or one a point
  std::vector<std::uint32_t> corners;  ///< three a triangle
};

/// Decodes the extension KHR_draco_mesh_compression of a primitive. Fails where it cannot.
DracoMesh decode_draco(GltfDocument& document, const nlohmann::json& compression,
                       const std::string& where);

}  // namespace enfilade
