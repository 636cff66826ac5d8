// The nodes of a glTF scene with their places.
#pragma once

#include <optional>

#include "base/warnings.hpp"
#include "import/gltf/gltf_document.hpp"
#include "import/intake/affine.hpp"

namespace enfilade {

struct GltfNode {
  std::size_t number = 0;        ///< in the file
  std::string object;            ///< its name, or that of the named node above it; unique
  std::vector<Affine> to_world;  ///< one, or one for each instance (EXT_mesh_gpu_instancing)
  std::optional<std::size_t> mesh, light;
};

/// Returns the nodes of the default scene that hold a mesh or a lamp (KHR_lights_punctual), in the
/// order of the tree. Fails where a node has two parents or is above itself.
std::vector<GltfNode> gltf_nodes(GltfDocument& document, const Affine& to_scene,
                                 Warnings& warnings);

}  // namespace enfilade
