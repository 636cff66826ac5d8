#include "import/obj/obj_import.hpp"

#include <charconv>
#include <set>

#include "base/error.hpp"
#include "import/intake/mesh_surfaces.hpp"
#include "import/intake/text_lines.hpp"
#include "import/obj/obj_material.hpp"
#include "json/json_text.hpp"

namespace enfilade {
namespace {

class ObjReader {
 public:
  ObjReader(const std::string& path, const ImportOptions& options, Warnings& warnings)
      : files_(path, options.allow_outside),
        warnings_(warnings),
        to_world_(to_scene(options, 'y', 1.0)),
        surfaces_(scene_, warnings) {
    scene_.file = path;
    scene_.bands = 3;
    scene_.unit = ExitanceUnit::lumen_per_m2;
  }

  Scene read() {
    TextLines lines(scene_.file, files_.read_text(scene_.file, {scene_.file, "file"}));
    while (lines.next()) read_line(lines);
    finish_mesh();
    scene_.hash = files_.hash();
    if (any_face_) return std::move(scene_);
    throw InputError(scene_.file, "file", "holds no faces", "export the model with its polygons");
  }

 private:
  void read_line(const TextLines& lines) {
    const std::string_view key = lines.words()[0];
    if (key == "v") {
      points_.push_back(to_world_(Vec3(lines.real(1), lines.real(2), lines.real(3))));
    } else if (key == "f" || key == "fo") {
      read_face(lines);
    } else if (key == "o" || key == "g") {
      finish_mesh();
      // Groups are parts of an object where objects are named, and objects where none is.
      (key == "o" ? object_ : group_) = lines.rest();
      if (key == "o") group_.clear();
    } else if (key == "usemtl") {
      finish_mesh();
      material_ = lines.rest();
    } else if (key == "mtllib") {
      read_libraries(lines);
    } else {
      static const std::set<std::string_view> silent{
          "vt",         "vn",        "s",     "vp", "l",        "p",       "lod",
          "shadow_obj", "trace_obj", "bevel", "mg", "c_interp", "d_interp"};
      if (!silent.contains(key))
        warnings_.add("line " + std::to_string(lines.number()),
                      in_quotes(std::string(key.substr(0, 40))) + " is not carried out");
    }
  }

  void read_face(const TextLines& lines) {
    if (lines.words().size() < 4) {
      lines.fail("a face has " + std::to_string(lines.words().size() - 1) + " corners",
                 "a polygon needs 3 or more");
    }
    IndexLoop loop;
    for (std::size_t word = 1; word < lines.words().size(); ++word)
      loop.push_back(local_point(point_number(lines, lines.words()[word])));
    if (to_world_.mirrors()) std::reverse(loop.begin(), loop.end());
    mesh_.faces.push_back(std::move(loop));
    any_face_ = true;
    if (mesh_.faces.size() % 65536 == 0) surfaces_.reserve(mesh_.faces.size() / 4);
  }

  std::uint32_t point_number(const TextLines& lines, std::string_view word) const {
    const std::string_view text = word.substr(0, word.find('/'));
    long long number = 0;
    const auto [stop, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
    const auto count = static_cast<long long>(points_.size());
    if (number < 0) number += count + 1;
    if (fault != std::errc() || stop != text.data() + text.size() || number < 1 || number > count) {
      lines.fail("a face names point " + in_quotes(std::string(text.substr(0, 40))) + " of " +
                     std::to_string(count),
                 "name points by their numbers, from 1");
    }
    return static_cast<std::uint32_t>(number - 1);
  }

  std::uint32_t local_point(std::uint32_t global) {
    const auto [it, is_new] =
        local_.try_emplace(global, static_cast<std::uint32_t>(mesh_.points.size()));
    if (is_new) mesh_.points.push_back(points_[global]);
    return it->second;
  }

  void read_libraries(const TextLines& lines) {
    // Names may have blanks in them, and one line may name several libraries.
    std::vector<std::string> names{lines.file_name_from(1)};
    if (!exists(names[0], lines) && lines.words().size() > 2) {
      names.clear();
      for (std::size_t word = 1; word < lines.words().size(); ++word)
        names.push_back(TextLines::file_name(std::string(lines.words()[word])));
    }
    for (const std::string& name : names) {
      if (exists(name, lines)) {
        read_obj_materials(path_of(name, lines), files_, {lines.file(), lines.where()}, warnings_,
                           materials_);
      } else {
        warnings_.add("mtllib " + in_quotes(name),
                      "does not exist: its materials are taken as grey, reflectance 0.5");
      }
    }
  }

  static std::string path_of(const std::string& name, const TextLines& lines) {
    return ModelFiles::path_from(lines.file(), name);
  }
  static bool exists(const std::string& name, const TextLines& lines) {
    return !name.empty() && ModelFiles::exists(path_of(name, lines));
  }

  void finish_mesh() {
    if (!mesh_.faces.empty()) {
      ModelMaterial plain;
      const auto material = materials_.find(material_);
      if (material == materials_.end() && told_.insert(material_).second) {
        warnings_.add(
            material_.empty() ? "faces before any usemtl" : "material " + in_quotes(material_),
            material_.empty() ? "have no material: reflectance taken as 0.5"
                              : "is not defined: reflectance taken as 0.5");
      }
      mesh_.object = object_.empty() ? group_ : object_;
      mesh_.name = group_.empty() ? mesh_.object : group_;
      surfaces_.add(mesh_, material == materials_.end() ? plain : material->second);
    }
    mesh_ = {};
    local_.clear();
  }

  ModelFiles files_;
  Warnings& warnings_;
  Affine to_world_;
  Scene scene_;
  MeshSurfaces surfaces_;
  std::map<std::string, ModelMaterial> materials_;
  std::set<std::string> told_;  ///< materials that are missing
  std::vector<Vec3> points_;
  std::map<std::uint32_t, std::uint32_t> local_;  ///< of the mesh, by the number in the file
  ModelMesh mesh_;
  bool any_face_ = false;
  std::string object_, group_, material_;
};

}  // namespace

Scene import_obj(const std::string& path, const ImportOptions& options, Warnings& warnings) {
  return ObjReader(path, options, warnings).read();
}

}  // namespace enfilade
