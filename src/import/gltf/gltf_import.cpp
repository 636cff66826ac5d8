#include "import/gltf/gltf_import.hpp"

#include <cmath>
#include <numbers>

#include "base/error.hpp"
#include "import/gltf/gltf_material.hpp"
#include "import/gltf/gltf_nodes.hpp"
#include "import/gltf/gltf_primitive.hpp"
#include "json/json_text.hpp"

namespace enfilade {
namespace {

using Json = nlohmann::json;

/// What is carried out; other extensions are left out with a word, and refused where required.
const std::vector<std::string_view> known_extensions{
    "KHR_draco_mesh_compression", "EXT_meshopt_compression",
    "KHR_meshopt_compression",    "KHR_mesh_quantization",
    "EXT_mesh_gpu_instancing",    "KHR_node_visibility",
    "KHR_lights_punctual",        "KHR_materials_emissive_strength",
    "KHR_materials_transmission", "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_unlit",        "KHR_texture_transform"};

class GltfReader {
 public:
  GltfReader(const std::string& path, const ImportOptions& options, Warnings& warnings)
      : files_(path, options.allow_outside),
        document_(files_, known_extensions),
        warnings_(warnings),
        options_(options),
        materials_(document_, warnings),
        surfaces_(scene_, warnings) {
    scene_.file = path;
    scene_.bands = 3;
    scene_.unit = ExitanceUnit::lumen_per_m2;
  }

  Scene read() {
    warn_of_left_out();
    for (const GltfNode& node : gltf_nodes(document_, to_scene(options_, 'y', 1.0), warnings_)) {
      if (node.mesh) add_mesh(node);
      if (node.light) add_light(node);
    }
    scene_.hash = files_.hash();
    if (any_triangle_) return std::move(scene_);
    throw InputError(scene_.file, "meshes", "holds no polygons", "export the model with its faces");
  }

 private:
  void warn_of_left_out() {
    std::string names;
    const auto used = document_.root().find("extensionsUsed");
    if (used != document_.root().end() && used->is_array()) {
      for (const Json& name : *used) {
        const std::string word = name.is_string() ? name.get<std::string>() : "";
        if (std::find(known_extensions.begin(), known_extensions.end(), word) ==
            known_extensions.end())
          names += (names.empty() ? "" : ", ") + word;
      }
    }
    if (!names.empty()) warnings_.add(names, "extensions that are not carried out");
    if (document_.count("animations") > 0)
      warnings_.add("animations", "left out: all stands as at rest");
  }

  const std::vector<GltfPrimitive>& primitives_of(std::size_t mesh, const std::string& user) {
    const auto known = primitives_.find(mesh);
    if (known != primitives_.end()) return known->second;
    const Json& entry = document_.entry("meshes", mesh, user);
    const std::string where = "meshes[" + std::to_string(mesh) + "].primitives";
    const auto list = entry.find("primitives");
    if (list == entry.end() || !list->is_array())
      document_.fail(where, "is no list", "export the model again");
    std::vector<GltfPrimitive> primitives;
    for (std::size_t i = 0; i < list->size(); ++i) {
      const std::string place = where + "[" + std::to_string(i) + "]";
      if (!(*list)[i].is_object())
        document_.fail(place, "is not an object", "export the model again");
      primitives.push_back(read_primitive(document_, (*list)[i], place, warnings_));
      any_triangle_ |= !primitives.back().triangles.empty();
    }
    return primitives_.emplace(mesh, std::move(primitives)).first->second;
  }

  void add_mesh(const GltfNode& node) {
    const std::string user = "nodes[" + std::to_string(node.number) + "].mesh";
    const std::vector<GltfPrimitive>& primitives = primitives_of(*node.mesh, user);
    const std::string name = document_.text(document_.entry("meshes", *node.mesh, user), "name");
    std::size_t instance = 0;
    for (const Affine& to_world : node.to_world) {
      std::string object = node.object.empty() ? name : node.object;
      if (++instance > 1) object += "#" + std::to_string(instance);
      for (const GltfPrimitive& primitive : primitives)
        add_primitive(primitive, to_world, name.empty() ? object : name, object);
    }
  }

  void add_primitive(const GltfPrimitive& primitive, const Affine& to_world,
                     const std::string& name, const std::string& object) {
    surfaces_.reserve(primitive.triangles.size() / 16);
    ModelMesh whole{{}, {}, name, object};
    for (const Vec3& p : primitive.points) whole.points.push_back(to_world(p));
    // One mesh for each colour, to a step of 1/255.
    std::map<std::array<int, 3>, ModelMesh> by_colour;
    for (const auto& [a, b, c] : primitive.triangles) {
      std::array<int, 3> colour{255, 255, 255};
      for (std::size_t i = 0; i < 3 && !primitive.colours.empty(); ++i) {
        const double mean =
            (primitive.colours[a][i] + primitive.colours[b][i] + primitive.colours[c][i]) / 3.0;
        colour[i] = static_cast<int>(std::lround(255.0 * std::clamp(mean, 0.0, 1.0)));
      }
      IndexLoop loop{a, b, c};
      if (to_world.mirrors()) std::reverse(loop.begin(), loop.end());
      by_colour[colour].faces.push_back(std::move(loop));
    }
    for (auto& [colour, mesh] : by_colour) {
      whole.faces = std::move(mesh.faces);
      surfaces_.add(whole,
                    materials_.material(primitive.material,
                                        {colour[0] / 255.0, colour[1] / 255.0, colour[2] / 255.0},
                                        in_quotes(name)));
    }
  }

  void add_light(const GltfNode& node) {
    const Json* all = document_.extension(document_.root(), "KHR_lights_punctual");
    const std::string where = "nodes[" + std::to_string(node.number) + "]";
    if (all == nullptr || !all->contains("lights") || !(*all)["lights"].is_array() ||
        *node.light >= (*all)["lights"].size())
      document_.fail(where, "names a light that is not there", "export the model again");
    const Json& light = (*all)["lights"][*node.light];
    const std::string place = "lights[" + std::to_string(*node.light) + "]";
    const std::string type = document_.text(light, "type");
    if (type != "point" && type != "spot") {
      warnings_.add(in_quotes(node.object),
                    "light of type " + in_quotes(type.substr(0, 40)) + ": left out");
      return;
    }
    const double intensity = document_.real(light, "intensity", 1.0, place);
    const std::vector<double> colour = document_.reals(light, "color", {1, 1, 1}, place);
    Spectrum bands;
    for (const double c : colour) {
      if (intensity * c < 0.0)
        document_.fail(place, "has an intensity or a colour below zero", "write 0 or more");
      bands.push_back(intensity * c);
    }
    const Vec3 p = node.to_world[0].shift, axis = node.to_world[0].linear * Vec3(0.0, 0.0, -1.0);
    const bool aimed = glm::length(axis) > 0.0 && std::isfinite(glm::length(axis));
    LightSource made{p, bands};
    if (type == "spot" && aimed) made = spot_light(p, axis, bands, cone_of(light, place));
    if (aimed) made.frame = LightFrame::of(axis);
    made.name = node.object;
    scene_.lights.push_back(std::move(made));
  }

  SpotCone cone_of(const Json& light, const std::string& where) {
    const auto spot = light.find("spot");
    const Json none = Json::object();
    const Json& angles = spot != light.end() && spot->is_object() ? *spot : none;
    const SpotCone cone{document_.real(angles, "innerConeAngle", 0.0, where),
                        document_.real(angles, "outerConeAngle", std::numbers::pi / 4.0, where)};
    if (!(cone.inner >= 0.0 && cone.inner <= cone.outer && cone.outer > 1e-4 &&
          cone.outer <= std::numbers::pi)) {
      document_.fail(where, "has cone angles that do not grow from 0 to pi",
                     "export the model again");
    }
    return cone;
  }

  ModelFiles files_;
  GltfDocument document_;
  Warnings& warnings_;
  ImportOptions options_;
  Scene scene_;
  GltfMaterials materials_;
  MeshSurfaces surfaces_;
  std::map<std::size_t, std::vector<GltfPrimitive>> primitives_;
  bool any_triangle_ = false;
};

}  // namespace

Scene import_gltf(const std::string& path, const ImportOptions& options, Warnings& warnings) {
  return GltfReader(path, options, warnings).read();
}

}  // namespace enfilade
