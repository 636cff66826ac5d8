// The diffuse part of glTF's materials, and the light that they give off.
#pragma once

#include <map>
#include <optional>

#include "base/warnings.hpp"
#include "import/gltf/gltf_document.hpp"
#include "import/intake/mesh_surfaces.hpp"
#include "import/intake/texture_mean.hpp"

namespace enfilade {

/// Base (or diffuse) colour times the mean of its texture in linear light is the reflectance;
/// emission, a luminance in cd/m2, times KHR_materials_emissive_strength makes an exitance of pi
/// times that. Alpha counts as alphaMode says; what passes more than half of the light by it is
/// open. KHR_materials_transmission makes panes: each face passes its factor times the base colour,
/// and reflects the rest of it.
class GltfMaterials {
 public:
  GltfMaterials(GltfDocument& document, Warnings& warnings)
      : document_(document), warnings_(warnings) {}

  /// Returns material `index` for faces of vertex colour `colour`; of a file without that material
  /// where none. The first use warns of what is left out.
  ModelMaterial material(std::optional<std::size_t> index, const Spectrum& colour,
                         const std::string& user);

 private:
  using Json = GltfDocument::Json;
  struct Entry {
    ModelMaterial material;
    Spectrum colour;       ///< base colour, before reflectance_of()
    double passing = 0.0;  ///< share of the light that passes, in the base colour
  };

  const Entry& read(std::size_t index, const std::string& user);
  void read_colours(const Json& source, Entry& entry, double& alpha, const std::string& where);
  void read_emission(const Json& source, Entry& entry, const std::string& where);
  double transmission(const Json& source, const std::string& where);
  bool opaque(const Json& source, double alpha, const std::string& where);
  /// Mean of the texture under a key of `object`; none where it has none.
  std::optional<TextureMean> texture(const Json& object, const char* key, const std::string& where);
  std::optional<TextureMean> image_mean(std::size_t image, const std::string& where);

  GltfDocument& document_;
  Warnings& warnings_;
  std::map<std::size_t, Entry> read_;
  std::map<std::size_t, std::optional<TextureMean>> means_;  ///< by image
};

}  // namespace enfilade
