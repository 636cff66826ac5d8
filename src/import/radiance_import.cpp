#include "import/radiance_import.hpp"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/error.hpp"
#include "import/radiance_modifiers.hpp"
#include "import/radiance_shapes.hpp"
#include "import/radiance_xform.hpp"
#include "json/json_text.hpp"

namespace enfilade {
namespace {

namespace fs = std::filesystem;

/// How deep files may take in others; real models need three or four.
constexpr std::size_t deepest = 32;

class RadianceReader {
 public:
  explicit RadianceReader(Warnings& warnings) : warnings_(warnings) {}

  Scene read(const std::string& path) {
    scene_.file = path;
    scene_.bands = 3;
    scene_.unit = ExitanceUnit::watt_per_m2;
    read_file(path, {}, "");
    warn_of_skipped();
    if (scene_.surfaces.empty()) {
      throw InputError(path, "file", "holds no polygons or other shapes",
                       "give a Radiance scene description with geometry");
    }
    return std::move(scene_);
  }

 private:
  void read_file(const std::string& path, const RadianceTransform& to_world,
                 const std::string& prefix) {
    const std::string bytes = read_bytes(path);
    scene_.hash = XXH64(bytes.data(), bytes.size(), scene_.hash);
    open_files_.push_back(fs::weakly_canonical(path));
    RadianceText text(path, bytes);
    while (!text.at_end()) {
      if (text.at_command()) {
        const RadiancePlace place = text.place();
        take_in(parse_radiance_xform(text.command(), place), place, to_world, prefix);
      } else {
        take(read_radiance_primitive(text), to_world, prefix);
      }
    }
    open_files_.pop_back();
  }

  void take_in(const RadianceXform& xform, const RadiancePlace& place,
               const RadianceTransform& to_world, const std::string& prefix) {
    for (const std::string& file : xform.files) {
      const fs::path path = fs::path(place.file).parent_path() / file;
      if (!fs::exists(path)) {
        place.fail(radiance_quoted(file) + " does not exist",
                   "name a file by its path from the folder of this one");
      }
      if (std::count(open_files_.begin(), open_files_.end(), fs::weakly_canonical(path)) > 0)
        place.fail(radiance_quoted(file) + " takes in itself", "break the cycle of xform lines");
      if (open_files_.size() >= deepest) {
        place.fail("files take in others more than " + std::to_string(deepest) + " deep",
                   "expand the file with Radiance's own xform first");
      }
      const bool both = !prefix.empty() && !xform.prefix.empty();
      read_file(path.string(), xform.transform.then(to_world),
                prefix + (both ? "." : "") + xform.prefix);
    }
  }

  void take(const RadiancePrimitive& primitive, const RadianceTransform& to_world,
            const std::string& prefix) {
    if (primitive.kind == RadianceKind::object) {
      skipped_.push_back(primitive.label());
    } else if (primitive.kind == RadianceKind::shape) {
      const RadianceMaterial material = modifiers_.material_of(primitive, warnings_);
      for (Polygon& polygon : radiance_polygons(primitive)) {
        if (material.passes_light) continue;
        add_surfaces(to_world.image_of(std::move(polygon)), material, primitive, prefix);
      }
    } else {
      modifiers_.define(primitive);
    }
  }

  void add_surfaces(Polygon polygon, const RadianceMaterial& material,
                    const RadiancePrimitive& shape, const std::string& prefix) {
    for (const Vec3& p : polygon) {
      if (!std::isfinite(p.x + p.y + p.z))
        shape.place.fail(shape.label() + " lies infinitely far away", "correct its numbers");
    }
    Surface surface;
    surface.vertices = std::move(polygon);
    surface.reflectance = material.reflectance;
    surface.exitance = material.exitance;
    surface.name = prefix.empty() ? shape.name : prefix + "." + shape.name;
    surface.object = prefix.empty() ? shape.name : prefix;
    // A scene's two-sided surface emits from both sides; one that emits needs a back of its own.
    surface.two_sided = material.reflects() && !material.emits();
    scene_.surfaces.push_back(surface);
    if (!material.reflects() || !material.emits()) return;
    std::reverse(surface.vertices.begin(), surface.vertices.end());
    surface.exitance.assign(surface.exitance.size(), 0.0);
    scene_.surfaces.push_back(std::move(surface));
  }

  void warn_of_skipped() {
    constexpr std::size_t most = 10;
    if (skipped_.empty()) return;
    std::string names;
    for (std::size_t i = 0; i < std::min(skipped_.size(), most); ++i)
      names += (i == 0 ? "" : ", ") + skipped_[i];
    if (skipped_.size() > most) names += ", ...";
    warnings_.add(names, "left out, as a scene can't hold it (" + std::to_string(skipped_.size()) +
                             " in all)");
  }

  Warnings& warnings_;
  Scene scene_;
  RadianceModifiers modifiers_;
  std::vector<fs::path> open_files_;  ///< each takes in the next
  std::vector<std::string> skipped_;
};

}  // namespace

Scene import_radiance(const std::string& path, Warnings& warnings) {
  return RadianceReader(warnings).read(path);
}

}  // namespace enfilade
