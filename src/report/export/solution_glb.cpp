#include "report/export/solution_glb.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "report/export/glb_writer.hpp"
#include "report/pictures/scene_tone.hpp"
#include "scene/equal_bands.hpp"

namespace enfilade {

namespace {

using Json = nlohmann::ordered_json;
constexpr int float_type = 5126, ushort_type = 5123, uint_type = 5125;
constexpr int vertex_target = 34962, index_target = 34963;

struct Vertex {
  Vec2 at;
  Spectrum radiosity, irradiance;
  int leaves = 0;
};

/// One polygon's leaf patches as triangles; light at a corner is the mean of the patches that meet
/// there, so that it runs on smoothly from one to the next.
class PolygonMesh {
 public:
  PolygonMesh(const Scene& scene, const PatchForest& forest, std::span<const std::size_t> leaves)
      : forest_(forest) {
    for (std::size_t leaf : leaves) {
      const PatchShape& shape = forest.node(leaf).shape;
      std::vector<std::uint32_t> corners;
      for (const Vec2& corner : shape.vertices) corners.push_back(add(leaf, corner));
      for (std::size_t i = 2; i < corners.size(); ++i) {
        for (std::uint32_t c : {corners[0], corners[i - 1], corners[i]}) indices.push_back(c);
      }
    }
    for (Vertex& v : vertices) {
      for (double& b : v.radiosity) b = std::max(0.0, b / v.leaves);
      for (double& e : v.irradiance) e = std::max(0.0, e / v.leaves);
      v.radiosity = in_bands_of_file(scene, v.radiosity);
      v.irradiance = in_bands_of_file(scene, v.irradiance);
    }
  }
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;

 private:
  std::uint32_t add(std::size_t leaf, const Vec2& corner) {
    constexpr double grid_m = 1e-6;
    const std::pair key(std::llround(corner.x / grid_m), std::llround(corner.y / grid_m));
    const auto [at, fresh] =
        by_place_.try_emplace(key, static_cast<std::uint32_t>(vertices.size()));
    const std::size_t bands = static_cast<std::size_t>(forest_.bands());
    if (fresh) vertices.push_back({corner, Spectrum(bands, 0.0), Spectrum(bands, 0.0), 0});
    Vertex& v = vertices[at->second];
    ++v.leaves;
    const Vec2 shift = corner - forest_.node(leaf).shape.centroid;
    add_light(forest_.radiosity(leaf), shift, v.radiosity);
    add_light(forest_.irradiance(leaf), shift, v.irradiance);
    return at->second;
  }
  void add_light(std::span<const double> light, const Vec2& shift, Spectrum& sum) const {
    const std::size_t terms = static_cast<std::size_t>(forest_.terms());
    for (std::size_t band = 0; band < sum.size(); ++band) {
      const double* l = light.data() + band * terms;
      sum[band] += l[0] + (terms == 3 ? l[1] * shift.x + l[2] * shift.y : 0.0);
    }
  }

  const PatchForest& forest_;
  std::map<std::pair<long long, long long>, std::uint32_t> by_place_;
};

std::vector<std::vector<std::size_t>> leaves_by_polygon(const PatchForest& forest) {
  std::vector<std::vector<std::size_t>> leaves(forest.polygons());
  for (std::size_t i = 0; i < forest.size(); ++i) {
    if (forest.node(i).leaf()) leaves[forest.node(i).id.root].push_back(i);
  }
  return leaves;
}

/// The binary chunk's four runs, and the objects' ranges in them.
class Mesh {
 public:
  struct Object {
    std::size_t first_vertex = 0, vertices = 0, first_index = 0, indices = 0;
    float lo[3] = {1e30f, 1e30f, 1e30f}, hi[3] = {-1e30f, -1e30f, -1e30f};
  };
  std::vector<float> positions, irradiance;
  std::vector<std::uint16_t> colours;
  std::vector<std::uint32_t> indices;
  std::vector<Object> objects;

  void begin_object() {
    objects.emplace_back();
    objects.back().first_vertex = irradiance.size();
    objects.back().first_index = indices.size();
  }
  void add(const PolygonMesh& polygon, const PolygonFrame& frame, const Vec3& centre,
           const ToneMap& tone) {
    Object& object = objects.back();
    for (std::uint32_t i : polygon.indices) {
      indices.push_back(static_cast<std::uint32_t>(object.vertices) + i);
    }
    object.indices += polygon.indices.size();
    object.vertices += polygon.vertices.size();
    for (const Vertex& v : polygon.vertices) {
      const Vec3 p = frame.at(v.at) - centre;
      for (int c = 0; c < 3; ++c) {
        positions.push_back(static_cast<float>(p[c]));
        object.lo[c] = std::min(object.lo[c], positions.back());
        object.hi[c] = std::max(object.hi[c], positions.back());
      }
      for (double shown : tone(display_rgb(v.radiosity))) {
        colours.push_back(static_cast<std::uint16_t>(std::lround(65535.0 * shown)));
      }
      colours.push_back(65535);
      double mean = 0.0;
      for (double e : v.irradiance) mean += e / static_cast<double>(v.irradiance.size());
      irradiance.push_back(static_cast<float>(mean));
    }
  }
};

/// Objects in the order in which they first come; polygons without a name are one object.
Mesh build_mesh(const SolvedScene& solved, const ToneMap& tone, const Vec3& centre,
                std::vector<std::string>& names) {
  std::map<std::string, std::vector<std::pair<std::size_t, std::size_t>>> parts;
  std::vector<std::vector<std::vector<std::size_t>>> leaves;
  for (std::size_t c = 0; c < solved.states.size(); ++c) {
    const PatchForest& forest = solved.states[c].patches();
    leaves.push_back(leaves_by_polygon(forest));
    for (std::size_t k = 0; k < forest.polygons(); ++k) {
      const std::string& object = solved.scene.surfaces[forest.frames()[k].surface.index()].object;
      auto& list = parts[object];
      if (list.empty()) names.push_back(object);
      list.emplace_back(c, k);
    }
  }
  Mesh mesh;
  for (const std::string& name : names) {
    mesh.begin_object();
    for (const auto& [c, k] : parts[name]) {
      const PatchForest& forest = solved.states[c].patches();
      mesh.add(PolygonMesh(solved.scene, forest, leaves[c][k]), forest.frames()[k], centre, tone);
    }
  }
  return mesh;
}

void add_objects(GlbWriter& glb, const Mesh& mesh, const std::vector<std::string>& names) {
  const std::size_t position = glb.add_view(mesh.positions, vertex_target);
  const std::size_t colour = glb.add_view(mesh.colours, vertex_target);
  const std::size_t irradiance = glb.add_view(mesh.irradiance, vertex_target);
  const std::size_t index = glb.add_view(mesh.indices, index_target);
  glb.json["bufferViews"][position]["byteStride"] = 12;
  glb.json["bufferViews"][colour]["byteStride"] = 8;
  glb.json["bufferViews"][irradiance]["byteStride"] = 4;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Mesh::Object& o = mesh.objects[i];
    const std::size_t p =
        glb.add_accessor(position, 12 * o.first_vertex, float_type, o.vertices, "VEC3");
    glb.json["accessors"][p]["min"] = o.lo;
    glb.json["accessors"][p]["max"] = o.hi;
    const std::size_t c =
        glb.add_accessor(colour, 8 * o.first_vertex, ushort_type, o.vertices, "VEC4");
    glb.json["accessors"][c]["normalized"] = true;
    const std::size_t e =
        glb.add_accessor(irradiance, 4 * o.first_vertex, float_type, o.vertices, "SCALAR");
    const std::size_t t =
        glb.add_accessor(index, 4 * o.first_index, uint_type, o.indices, "SCALAR");
    const std::string name = names[i].empty() ? "surfaces" : names[i];
    glb.json["meshes"].push_back(
        {{"name", name},
         {"primitives",
          {{{"attributes", {{"POSITION", p}, {"COLOR_0", c}, {"_IRRADIANCE", e}}},
            {"indices", t},
            {"material", 0}}}}});
    glb.json["nodes"].push_back({{"name", name}, {"mesh", i}});
    glb.json["nodes"][0]["children"].push_back(i + 1);
  }
}

}  // namespace

std::string solution_glb(const SolvedScene& solved, const ToneConfig& config) {
  Box box;
  for (const Cluster& cluster : solved.clusters) box.add(cluster.bounds);
  // Single precision is relative to the building, wherever it stands.
  const Vec3 centre = box.empty() ? Vec3(0.0) : box.center();
  const ToneMap tone = scene_tone_map(solved, config);
  std::vector<std::string> names;
  const Mesh mesh = build_mesh(solved, tone, centre, names);
  GlbWriter glb;
  glb.json["asset"] = {
      {"version", "2.0"},
      {"generator", "enfilade"},
      {"extras",
       {{"irradianceUnit", irradiance_label(solved.scene.unit)}, {"exposure", tone.exposure()}}}};
  glb.json["extensionsUsed"] = {"KHR_materials_unlit"};
  glb.json["scene"] = 0;
  glb.json["scenes"] = {{{"nodes", {0}}}};
  // A quarter turn makes z-up y-up.
  const double half = std::sqrt(0.5);
  glb.json["nodes"] = {{{"name", "building"},
                        {"rotation", {-half, 0.0, 0.0, half}},
                        {"translation", {centre.x, centre.z, -centre.y}}}};
  glb.json["materials"] = {
      {{"name", "radiosity"},
       {"pbrMetallicRoughness", {{"metallicFactor", 0.0}, {"roughnessFactor", 1.0}}},
       {"extensions", {{"KHR_materials_unlit", Json::object()}}}}};
  if (!names.empty()) {
    add_objects(glb, mesh, names);
    glb.json["buffers"] = {{{"byteLength", glb.chunk.size()}}};
  }
  return glb.bytes();
}

}  // namespace enfilade
