#include "import/import_model.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "base/error.hpp"
#include "import/gltf/gltf_import.hpp"
#include "import/ifc/ifc_import.hpp"
#include "import/intake/mesh_surfaces.hpp"
#include "import/intake/own_process.hpp"
#include "import/intake/scene_bytes.hpp"
#include "import/obj/obj_import.hpp"
#include "import/radiance/radiance_import.hpp"
#include "json/json_text.hpp"
#include "scene/scene_limits.hpp"
#include "scene_file/scene_io.hpp"

namespace enfilade {
namespace {

std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

/// Reads a model of one kind from its files.
using Reader = Scene (*)(const std::vector<std::string>&, const ImportOptions&, Warnings&);

template <Scene (*read)(const std::string&, const ImportOptions&, Warnings&)>
Scene of_one_file(const std::vector<std::string>& paths, const ImportOptions& options,
                  Warnings& warnings) {
  if (paths.size() > 1) {
    throw InputError(paths[1], "file", "is a second model",
                     "import each by itself: only Radiance's .rad files make one model together");
  }
  return read(paths[0], options, warnings);
}

/// None for a file of no kind that can be imported.
Reader reader_for(const std::string& extension) {
  if (extension == ".gltf" || extension == ".glb") return &of_one_file<&import_gltf>;
  if (extension == ".obj") return &of_one_file<&import_obj>;
  if (extension == ".ifc") return &of_one_file<&import_ifc>;
  if (extension == ".rad") return &import_radiance;
  return nullptr;
}

/// A model may have one material or part in many places: each thing is told once.
Warnings without_repeats(const Warnings& warnings) {
  Warnings once;
  std::set<std::pair<std::string, std::string>> told;
  for (const Warning& w : warnings.all())
    if (told.emplace(w.where, w.what).second) once.add(w.where, w.what);
  return once;
}

}  // namespace

Scene import_model(const std::vector<std::string>& paths, const ImportOptions& options,
                   Warnings& warnings) {
  ENFILADE_CHECK(!paths.empty(), "no file");
  const std::string extension = extension_of(paths[0]);
  const Reader reader = reader_for(extension);
  if (reader == nullptr) {
    throw InputError(paths[0], "file",
                     "is of no kind that can be imported (" + in_quotes(extension) + ")",
                     "give a .gltf, .glb, .obj, .ifc or .rad file");
  }
  const auto work = [&] {
    Warnings found;
    const Scene scene = reader(paths, options, found);
    check_limits(scene);
    check_shapes(scene, found);
    return bytes_of(scene, without_repeats(found));
  };
  return scene_from(in_own_process(paths[0], {}, work), warnings);
}

Scene import_model(const std::string& path, Warnings& warnings) {
  return import_model({path}, {}, warnings);
}

Scene read_scene_or_model(const std::string& path, Warnings& warnings, bool allow_outside) {
  if (reader_for(extension_of(path)) == nullptr) return read_scene(path, warnings, allow_outside);
  ImportOptions options;
  options.allow_outside = allow_outside;
  return import_model({path}, options, warnings);
}

}  // namespace enfilade
