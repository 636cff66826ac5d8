#include "import/gltf/gltf_nodes.hpp"

#include <algorithm>
#include <glm/gtc/quaternion.hpp>

#include "import/gltf/gltf_accessor.hpp"
#include "json/json_text.hpp"

namespace enfilade {
namespace {

using Json = nlohmann::json;

Affine placed(const Vec3& shift, const std::vector<double>& rotation, const Vec3& scale) {
  glm::dquat turn(rotation[3], rotation[0], rotation[1], rotation[2]);
  const double length = glm::length(turn);
  turn = length > 0.0 ? turn / length : glm::dquat(1.0, 0.0, 0.0, 0.0);
  glm::dmat3 linear = glm::mat3_cast(turn);
  for (int axis = 0; axis < 3; ++axis) linear[axis] *= scale[axis];
  return {linear, shift};
}

class TreeReader {
 public:
  TreeReader(GltfDocument& document, Warnings& warnings)
      : document_(document), warnings_(warnings), parents_(document.count("nodes")) {}

  std::vector<GltfNode> read(const Affine& to_scene) {
    check_tree();
    for (const std::size_t root : roots()) open_.push_back({root, to_scene, ""});
    std::reverse(open_.begin(), open_.end());
    // A list of what is still to be done, as chains of nodes may be longer than a stack is deep.
    while (!open_.empty()) {
      const Open next = std::move(open_.back());
      open_.pop_back();
      visit(next);
    }
    return std::move(nodes_);
  }

 private:
  struct Open {
    std::size_t number;
    Affine parent;
    std::string object;
  };

  static std::string at(std::size_t number) { return "nodes[" + std::to_string(number) + "]"; }

  std::vector<std::size_t> list(const Json& object, const char* key, const std::string& where) {
    std::vector<std::size_t> numbers;
    const auto it = object.find(key);
    if (it == object.end()) return numbers;
    for (const Json& value : *it) {
      if (!value.is_number_unsigned() || value.get<std::size_t>() >= parents_.size())
        document_.fail(where + "." + key, "names " + shown(value) + ", which is no node",
                       "export the model again");
      numbers.push_back(value.get<std::size_t>());
    }
    return numbers;
  }

  // The standard wants trees. What hangs below two nodes could double at every level.
  void check_tree() {
    for (std::size_t n = 0; n < parents_.size(); ++n) {
      for (const std::size_t child :
           list(document_.entry("nodes", n, "nodes"), "children", at(n))) {
        if (parents_[child]++ > 0)
          document_.fail(at(n) + ".children", "names " + at(child) + ", which has a parent already",
                         "write a tree: each node a child of at most one other, once");
      }
    }
  }

  std::vector<std::size_t> roots() {
    const std::size_t scenes = document_.count("scenes");
    std::vector<std::size_t> found;
    if (scenes > 0) {
      const std::size_t scene = document_.whole(document_.root(), "scene", 0, "top level");
      if (scenes > 1)
        warnings_.add("scenes", "one of several: scenes[" + std::to_string(scene) + "] is taken");
      const std::string where = "scenes[" + std::to_string(scene) + "]";
      found = list(document_.entry("scenes", scene, "scene"), "nodes", where);
      for (const std::size_t root : found) {
        if (parents_[root]++ > 0)
          document_.fail(where + ".nodes",
                         "names " + at(root) + ", which is a child or named twice",
                         "name each node at the top of a tree once");
      }
    } else {
      for (std::size_t n = 0; n < parents_.size(); ++n)
        if (parents_[n] == 0) found.push_back(n);
    }
    return found;
  }

  void visit(const Open& open) {
    const Json& node = document_.entry("nodes", open.number, "nodes");
    if (const Json* seen = document_.extension(node, "KHR_node_visibility")) {
      if (const auto it = seen->find("visible"); it != seen->end() && *it == false) return;
    }
    const Affine to_world = open.parent.after(local(node, at(open.number)));
    GltfNode found;
    found.number = open.number;
    const std::string name = document_.text(node, "name");
    found.object = name.empty() ? open.object : unique(name);
    if (node.contains("mesh")) found.mesh = document_.whole(node, "mesh", 0, at(open.number));
    if (const Json* lamp = document_.extension(node, "KHR_lights_punctual"))
      found.light = document_.need_whole(*lamp, "light", at(open.number));
    if (node.contains("skin"))
      warnings_.add(at(open.number), "skin is not carried out: the mesh stands as it is drawn");
    std::vector<std::size_t> children = list(node, "children", at(open.number));
    for (auto child = children.rbegin(); child != children.rend(); ++child)
      open_.push_back({*child, to_world, found.object});
    if (!found.mesh && !found.light) return;
    found.to_world = instances(node, to_world, at(open.number));
    nodes_.push_back(std::move(found));
  }

  /// Two nodes may bear one name, but they are two objects.
  std::string unique(const std::string& name) {
    const int count = ++names_[name];
    return count == 1 ? name : name + "#" + std::to_string(count);
  }

  Affine local(const Json& node, const std::string& where) {
    if (node.contains("matrix")) {
      const std::vector<double> m = document_.reals(node, "matrix", std::vector<double>(16), where);
      return {glm::dmat3(m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]),
              {m[12], m[13], m[14]}};
    }
    const auto t = document_.reals(node, "translation", {0, 0, 0}, where);
    const auto s = document_.reals(node, "scale", {1, 1, 1}, where);
    return placed({t[0], t[1], t[2]}, document_.reals(node, "rotation", {0, 0, 0, 1}, where),
                  {s[0], s[1], s[2]});
  }

  std::vector<Affine> instances(const Json& node, const Affine& to_world,
                                const std::string& where) {
    const Json* given = document_.extension(node, "EXT_mesh_gpu_instancing");
    if (given == nullptr || !given->contains("attributes")) return {to_world};
    const Json& attributes = (*given)["attributes"];
    const std::string place = where + ".extensions.EXT_mesh_gpu_instancing";
    std::optional<std::size_t> count;
    const auto values = [&](const char* key, std::size_t width) {
      GltfValues read;
      if (!attributes.is_object() || !attributes.contains(key)) return read;
      read = read_accessor(document_, document_.whole(attributes, key, 0, place), width, place);
      if (count && *count != read.count)
        document_.fail(place, "has lists of different lengths", "export the model again");
      count = read.count;
      return read;
    };
    const GltfValues t = values("TRANSLATION", 3), r = values("ROTATION", 4),
                     s = values("SCALE", 3);
    if (!count) return {to_world};
    std::vector<Affine> all;
    for (std::size_t i = 0; i < *count; ++i) {
      const Vec3 shift = t.count > 0 ? Vec3(t(i, 0), t(i, 1), t(i, 2)) : Vec3(0.0);
      const Vec3 scale = s.count > 0 ? Vec3(s(i, 0), s(i, 1), s(i, 2)) : Vec3(1.0);
      std::vector<double> rotation{0, 0, 0, 1};
      if (r.count > 0) rotation = {r(i, 0), r(i, 1), r(i, 2), r(i, 3)};
      all.push_back(to_world.after(placed(shift, rotation, scale)));
    }
    return all;
  }

  GltfDocument& document_;
  Warnings& warnings_;
  std::vector<int> parents_;  ///< how many each node has
  std::vector<Open> open_;
  std::vector<GltfNode> nodes_;
  std::map<std::string, int> names_;
};

}  // namespace

std::vector<GltfNode> gltf_nodes(GltfDocument& document, const Affine& to_scene,
                                 Warnings& warnings) {
  return TreeReader(document, warnings).read(to_scene);
}

}  // namespace enfilade
