// Models of other programs, through Assimp: glTF 2.0, OBJ with MTL, IFC. Radiance files have a
// reader of their own.
//
// Emission: glTF's emissiveFactor times KHR_materials_emissive_strength is a luminance in cd/m2,
// and a diffuse surface of luminance L has an exitance of pi L in lm/m2. OBJ's Ke is taken the same
// way. Intensities of KHR_lights_punctual are candela, that is lm/sr. An imported scene is
// therefore in lm/m2, with three bands.
#define XXH_INLINE_ALL
#include <xxhash.h>

#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>

#include "import/import_model.hpp"

#include "base/error.hpp"
#include "geometry/convex_merge.hpp"
#include "import/emissive_strength.hpp"
#include "import/radiance_import.hpp"
#include "json/json_text.hpp"
#include "scene_file/scene_io.hpp"

namespace enfilade {
namespace {

/// Rows of an affine map, in double: Assimp's own are float and add up their rounding down a deep
/// tree.
using Affine = std::array<std::array<double, 4>, 3>;

// Models are y-up; scenes are z-up.
constexpr Affine z_up{{{1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}}};

Affine times(const Affine& a, const aiMatrix4x4& b) {
  Affine c{};
  for (unsigned row = 0; row < 3; ++row) {
    for (unsigned column = 0; column < 4; ++column) {
      c[row][column] = column == 3 ? a[row][3] : 0.0;
      for (unsigned k = 0; k < 3; ++k)
        c[row][column] += a[row][k] * static_cast<double>(b[k][column]);
    }
  }
  return c;
}

Vec3 image_of(const Affine& m, const aiVector3D& v) {
  Vec3 p;
  for (int i = 0; i < 3; ++i) {
    const auto& row = m[static_cast<std::size_t>(i)];
    p[i] = row[0] * v.x + row[1] * v.y + row[2] * v.z + row[3];
  }
  return p;
}

bool mirrors(const Affine& m) {
  const auto column = [&](std::size_t c) { return Vec3(m[0][c], m[1][c], m[2][c]); };
  return glm::dot(glm::cross(column(0), column(1)), column(2)) < 0.0;
}

struct Material {
  Spectrum reflectance, exitance;
  bool two_sided = false, transparent = false;
};

class ModelReader {
 public:
  ModelReader(const std::string& path, Warnings& warnings) : path_(path), warnings_(warnings) {}

  Scene read() {
    const std::string bytes = read_bytes(path_);
    scene_.file = path_;
    scene_.hash = XXH64(bytes.data(), bytes.size(), 0);
    scene_.bands = 3;
    scene_.unit = ExitanceUnit::lumen_per_m2;
    Assimp::Importer importer;
    const aiScene* model = importer.ReadFile(path_, aiProcess_ValidateDataStructure);
    if (model == nullptr || model->mRootNode == nullptr) {
      throw InputError(path_, "file",
                       std::string("cannot be imported: ") + importer.GetErrorString(),
                       "export it again from its program");
    }
    model_ = model;
    read_materials(emissive_strengths(bytes));
    for (unsigned i = 0; i < model->mNumLights; ++i)
      lights_.emplace(model->mLights[i]->mName.C_Str(), model->mLights[i]);
    read_node(*model->mRootNode, z_up, "");
    if (scene_.surfaces.empty()) {
      throw InputError(path_, "meshes", "holds no polygons", "export the model with its faces");
    }
    return std::move(scene_);
  }

 private:
  Spectrum reflectance_of(const aiColor4D& base, const std::string& where) {
    // White is a colour in these formats, and may absorb light; a reflectance lies below 1.
    constexpr double highest_reflectance = 0.95;
    Spectrum bands;
    bool clamped = false;
    for (const double c : {base.r, base.g, base.b}) {
      bands.push_back(std::isfinite(c) ? std::clamp(c, 0.0, highest_reflectance) : 0.0);
      clamped |= bands.back() != c;
    }
    if (clamped) warnings_.add(where, "base colour above 0.95: reflectance taken as 0.95");
    return bands;
  }

  void read_materials(const std::vector<double>& strengths) {
    for (unsigned i = 0; i < model_->mNumMaterials; ++i) {
      const aiMaterial& source = *model_->mMaterials[i];
      std::string where = "materials[" + std::to_string(i) + "]";
      where.append(" ").append(in_quotes(source.GetName().C_Str()));
      aiColor4D base(0.5f, 0.5f, 0.5f, 1.0f), emission(0.0f, 0.0f, 0.0f, 1.0f);
      if (source.Get(AI_MATKEY_BASE_COLOR, base) != AI_SUCCESS)
        source.Get(AI_MATKEY_COLOR_DIFFUSE, base);
      source.Get(AI_MATKEY_COLOR_EMISSIVE, emission);
      float opacity = 1.0f, transmission = 0.0f;
      source.Get(AI_MATKEY_OPACITY, opacity);
      source.Get(AI_MATKEY_TRANSMISSION_FACTOR, transmission);
      int two_sided = 0;
      source.Get(AI_MATKEY_TWOSIDED, two_sided);

      Material material;
      if (used_materials().contains(i)) material.reflectance = reflectance_of(base, where);
      const double strength = i < strengths.size() ? strengths[i] : 1.0;
      for (const double c : {emission.r, emission.g, emission.b}) {
        material.exitance.push_back(std::isfinite(c) && c > 0.0 ? std::numbers::pi * strength * c
                                                                : 0.0);
      }
      material.two_sided = two_sided != 0;
      material.transparent = std::min(opacity, base.a) < 0.5f || transmission > 0.5f;
      if (source.GetTextureCount(aiTextureType_DIFFUSE) +
              source.GetTextureCount(aiTextureType_BASE_COLOR) >
          0) {
        warnings_.add(where, "texture ignored: its colour factor alone is the reflectance");
      }
      if (source.GetTextureCount(aiTextureType_EMISSIVE) > 0) {
        warnings_.add(where, "emission texture ignored: its factor alone is the exitance");
      }
      materials_.push_back(std::move(material));
    }
  }

  // Assimp adds a default material that often nothing uses; it deserves no warning.
  const std::map<unsigned, bool>& used_materials() {
    if (used_.empty()) {
      for (unsigned m = 0; m < model_->mNumMeshes; ++m)
        used_[model_->mMeshes[m]->mMaterialIndex] = true;
    }
    return used_;
  }

  void read_node(const aiNode& node, const Affine& parent, const std::string& parent_object) {
    const Affine to_world = times(parent, node.mTransformation);
    const std::string name = node.mName.C_Str();
    // Nodes that the importer made up for parts belong to the object above them.
    const bool is_part = name.empty() || name == "IfcMappedItem" || name[0] == '$';
    const std::string object = is_part ? parent_object : unique_object(name);
    for (unsigned m = 0; m < node.mNumMeshes; ++m)
      read_mesh(*model_->mMeshes[node.mMeshes[m]], to_world, object);
    const auto [first, last] = lights_.equal_range(node.mName.C_Str());
    for (auto it = first; it != last; ++it) read_light(*it->second, to_world);
    for (unsigned c = 0; c < node.mNumChildren; ++c)
      read_node(*node.mChildren[c], to_world, object);
  }

  // Two nodes may bear one name, but they are two objects.
  std::string unique_object(const std::string& name) {
    const int count = ++object_counts_[name];
    return count == 1 ? name : name + "#" + std::to_string(count);
  }

  void read_mesh(const aiMesh& mesh, const Affine& to_world, const std::string& object) {
    const Material& material = materials_.at(mesh.mMaterialIndex);
    if (material.transparent) {
      warnings_.add(in_quotes(object), "transparent: left out, light passes");
      return;
    }
    Box box;
    const std::vector<Vec3> corners = transformed(mesh, to_world, box);
    const std::vector<IndexLoop> loops = loops_of(mesh, corners, mirrors(to_world));
    // Single precision leaves relative errors of 1e-7 of the coordinates; flat is what survives
    // that.
    const double flat = 1e-5 * box.diagonal();
    for (const IndexLoop& loop : merge_convex(corners, loops, flat, 1e-4)) {
      Surface surface;
      for (const std::uint32_t i : loop) surface.vertices.push_back(corners[i]);
      surface.reflectance = material.reflectance;
      surface.exitance = material.exitance;
      surface.two_sided = material.two_sided;
      surface.name = mesh.mName.length > 0 ? mesh.mName.C_Str() : object;
      surface.object = object;
      scene_.surfaces.push_back(std::move(surface));
    }
  }

  std::vector<Vec3> transformed(const aiMesh& mesh, const Affine& to_world, Box& box) const {
    std::vector<Vec3> points;
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      points.push_back(image_of(to_world, mesh.mVertices[i]));
      const Vec3& p = points.back();
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
        std::string where = "mesh ";
        where.append(in_quotes(mesh.mName.C_Str())).append(" vertex ").append(std::to_string(i));
        throw InputError(path_, where, "is not finite", "correct it and export the model again");
      }
      box.add(p);
    }
    return points;
  }

  // Faces by the first vertex at each place: formats repeat vertices to give each face its own
  // normal.
  static std::vector<IndexLoop> loops_of(const aiMesh& mesh, const std::vector<Vec3>& points,
                                         bool mirrored) {
    std::map<std::array<double, 3>, std::uint32_t> first_at;
    std::vector<std::uint32_t> same(points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      same[i] = first_at.try_emplace({points[i].x, points[i].y, points[i].z}, i).first->second;
    }
    std::vector<IndexLoop> loops;
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices < 3) continue;  // points and lines have no area
      IndexLoop loop;
      for (unsigned k = 0; k < face.mNumIndices; ++k) loop.push_back(same[face.mIndices[k]]);
      if (mirrored) std::reverse(loop.begin(), loop.end());
      loops.push_back(std::move(loop));
    }
    return loops;
  }

  void read_light(const aiLight& light, const Affine& to_world) {
    if (light.mType != aiLightSource_POINT) {
      warnings_.add(in_quotes(light.mName.C_Str()), "not a point light: left out");
      return;
    }
    PointLight point;
    point.p = image_of(to_world, light.mPosition);
    for (const double c : {light.mColorDiffuse.r, light.mColorDiffuse.g, light.mColorDiffuse.b}) {
      point.intensity.push_back(std::isfinite(c) ? std::max(0.0, c) : 0.0);
    }
    scene_.lights.push_back(std::move(point));
  }

  std::string path_;
  Warnings& warnings_;
  Scene scene_;
  const aiScene* model_ = nullptr;
  std::vector<Material> materials_;
  std::map<unsigned, bool> used_;
  std::map<std::string, int> object_counts_;
  std::multimap<std::string, const aiLight*> lights_;
};

std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

/// Reads a model of this kind.
using ModelImport = Scene (*)(const std::string& path, Warnings& warnings);

/// None for a file of no kind that can be imported.
ModelImport import_for(const std::string& extension) {
  for (const char* known : {".gltf", ".glb", ".obj", ".ifc"}) {
    if (extension != known) continue;
    return [](const std::string& path, Warnings& warnings) {
      return ModelReader(path, warnings).read();
    };
  }
  return extension == ".rad" ? &import_radiance : nullptr;
}

}  // namespace

Scene import_model(const std::string& path, Warnings& warnings) {
  const std::string extension = extension_of(path);
  if (const ModelImport reader = import_for(extension)) return reader(path, warnings);
  throw InputError(path, "file", "is of no kind that can be imported (\"" + extension + "\")",
                   "give a .gltf, .glb, .obj, .ifc or .rad file");
}

Scene read_scene_or_model(const std::string& path, Warnings& warnings) {
  if (const ModelImport reader = import_for(extension_of(path))) return reader(path, warnings);
  return read_scene(path, warnings);
}

}  // namespace enfilade
