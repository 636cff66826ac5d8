#include "import/radiance/radiance_import.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/error.hpp"
#include "import/intake/affine.hpp"
#include "import/intake/mesh_surfaces.hpp"
#include "import/radiance/radiance_command.hpp"
#include "import/radiance/radiance_modifiers.hpp"
#include "import/radiance/radiance_shapes.hpp"
#include "json/json_text.hpp"

namespace enfilade {
namespace {

namespace fs = std::filesystem;

/// How deep files may take in others, and how often in all; real models need three or four, and a
/// few hundred.
constexpr std::size_t deepest = 32, most_files = 100'000;

class RadianceReader {
 public:
  RadianceReader(const std::vector<std::string>& paths, const ImportOptions& options,
                 Warnings& warnings)
      : files_(paths, options.allow_outside),
        warnings_(warnings),
        surfaces_(scene_, warnings),
        modifiers_(files_) {
    scene_.file = paths[0];
    scene_.bands = 3;
    scene_.unit = ExitanceUnit::watt_per_m2;
    const Affine map = to_scene(options, 'z', 1.0);
    to_scene_ = {map.linear, map.shift};
  }

  Scene read(const std::vector<std::string>& paths) {
    RadianceXform whole;
    whole.copies = {to_scene_};
    for (const std::string& path : paths) read_file(path, {path, "file"}, whole);
    warn_of_skipped();
    scene_.hash = files_.hash();
    if (scene_.surfaces.empty()) {
      throw InputError(scene_.file, "file", "holds no polygons or other shapes",
                       "give a Radiance scene description with geometry");
    }
    return std::move(scene_);
  }

 private:
  void read_file(const std::string& path, const ModelFiles::Place& named_at,
                 const RadianceXform& to_world) {
    open_files_.push_back(ModelFiles::canonical(path));
    RadianceText text(path, files_.read_text(path, named_at));
    while (!text.at_end()) {
      if (text.at_command()) {
        const RadiancePlace place = text.place();
        carry_out(parse_radiance_command(text.command(), place), place, to_world);
      } else {
        take(read_radiance_primitive(text), to_world);
      }
    }
    open_files_.pop_back();
  }

  void carry_out(const RadianceCommand& command, const RadiancePlace& place,
                 const RadianceXform& to_world) {
    if (!command.left_out.empty()) {
      skipped_.push_back("!" + command.left_out);
      return;
    }
    const RadianceXform placed = command.xform.then(to_world, place);
    if (!command.polygons.empty()) {
      RadiancePrimitive shape;
      shape.place = place;
      shape.modifier = command.modifier;
      shape.type = "polygon";
      shape.name = command.name;
      add_shape(shape, command.polygons, placed);
    }
    for (const std::string& file : command.xform.files) take_in(file, place, placed);
  }

  void take_in(const std::string& file, const RadiancePlace& place, const RadianceXform& placed) {
    const fs::path path = ModelFiles::path_from(place.file, file);
    if (!ModelFiles::exists(path.string())) {
      place.fail(radiance_quoted(file) + " does not exist",
                 "name a file by its path from the folder of this one");
    }
    if (std::count(open_files_.begin(), open_files_.end(), ModelFiles::canonical(path.string())) >
        0)
      place.fail(radiance_quoted(file) + " takes in itself", "break the cycle of xform lines");
    if (open_files_.size() >= deepest) {
      place.fail("files take in others more than " + std::to_string(deepest) + " deep",
                 "expand the file with Radiance's own xform first");
    }
    if (++files_taken_in_ > most_files) {
      place.fail("files are taken in more than " + std::to_string(most_files) + " times",
                 "look for files that take in others without end, or use xform -a");
    }
    read_file(path.string(), {place.file, "line " + std::to_string(place.line)}, placed);
  }

  void take(const RadiancePrimitive& primitive, const RadianceXform& to_world) {
    if (primitive.kind == RadianceKind::object) {
      skipped_.push_back(primitive.label());
    } else if (primitive.kind == RadianceKind::shape) {
      add_shape(primitive, radiance_polygons(primitive), to_world);
    } else {
      modifiers_.define(primitive);
    }
  }

  void add_shape(RadiancePrimitive shape, const std::vector<Polygon>& polygons,
                 const RadianceXform& to_world) {
    if (!to_world.modifier.empty()) shape.modifier = to_world.modifier;
    const RadianceMaterial material = modifiers_.material_of(shape, warnings_);
    if (material.passes_light) return;
    const bool ball = material.distribution && shape.type == "sphere" &&
                      material.distribution->source == RadianceSource::sphere;
    if (ball) {
      for (const RadianceTransform& copy : to_world.copies)
        add_ball(copy, material, shape, to_world.prefix);
      return;
    }
    surfaces_.reserve(polygons.size() * to_world.copies.size());
    for (const RadianceTransform& copy : to_world.copies) {
      for (const Polygon& polygon : polygons) {
        Polygon image = copy.image_of(polygon);
        if (to_world.inverts) std::reverse(image.begin(), image.end());
        add_surfaces(std::move(image), material, copy.linear, shape, to_world.prefix);
      }
    }
  }

  /// ies2rad's model of a point: a small ball whose light is that of the data.
  void add_ball(const RadianceTransform& copy, const RadianceMaterial& material,
                const RadiancePrimitive& shape, const std::string& prefix) {
    constexpr double smallest_opening_m = 0.02;
    const std::vector<double>& n = shape.numbers;
    const double radius = std::abs(n[3]) * std::cbrt(std::abs(glm::determinant(copy.linear)));
    LightSource light{copy.linear * Vec3(n[0], n[1], n[2]) + copy.shift, {}};
    for (const double exitance : material.exitance)  // the mean over the ball
      light.intensity.push_back(exitance * radius * radius);
    light.distribution = material.distribution->data;
    light.frame = material.distribution->frame(copy.linear);
    light.name = prefix.empty() ? shape.name : prefix + "." + shape.name;
    if (2.0 * radius > smallest_opening_m)
      light.shape = {OpeningShape::ellipsoid, Vec3(2.0 * radius)};
    scene_.lights.push_back(std::move(light));
  }

  void add_surfaces(Polygon polygon, const RadianceMaterial& material, const glm::dmat3& linear,
                    const RadiancePrimitive& shape, const std::string& prefix) {
    for (const Vec3& p : polygon) {
      if (!std::isfinite(p.x + p.y + p.z))
        shape.place.fail(shape.label() + " lies infinitely far away", "correct its numbers");
    }
    Surface surface;
    surface.vertices = std::move(polygon);
    surface.reflectance = material.reflectance;
    surface.exitance = material.exitance;
    surface.transmittance = material.transmittance;
    if (material.distribution && material.emits())
      distribute(*material.distribution, linear, surface);
    surface.name = prefix.empty() ? shape.name : prefix + "." + shape.name;
    surface.object = prefix.empty() ? shape.name : prefix;
    // A scene's two-sided surface emits from both sides; one that emits needs a back of its own.
    surface.two_sided = material.reflects() && !material.emits();
    scene_.surfaces.push_back(surface);
    if (!material.reflects() || !material.emits()) return;
    std::reverse(surface.vertices.begin(), surface.vertices.end());
    surface.exitance.assign(surface.exitance.size(), 0.0);
    surface.distribution = nullptr;
    scene_.surfaces.push_back(std::move(surface));
  }

  /// Each face of a source sends its own part of the light.
  static void distribute(const RadianceDistribution& distribution, const glm::dmat3& linear,
                         Surface& surface) {
    const Vec3 n = normal(surface.vertices);
    if (glm::length(n) <= 0.0) return;
    const RadianceFaceLight light = distribution.face_light(linear, n, surface.up);
    surface.distribution = light.distribution;
    // The material has the mean of the whole source.
    const double factor =
        distribution.exitance > 0.0 ? light.exitance / distribution.exitance : 0.0;
    for (double& band : surface.exitance) band *= factor;
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

  ModelFiles files_;
  Warnings& warnings_;
  Scene scene_;
  MeshSurfaces surfaces_;
  RadianceModifiers modifiers_;
  RadianceTransform to_scene_;
  std::vector<std::string> open_files_;  ///< each takes in the next
  std::size_t files_taken_in_ = 0;
  std::vector<std::string> skipped_;
};

}  // namespace

Scene import_radiance(const std::vector<std::string>& paths, const ImportOptions& options,
                      Warnings& warnings) {
  return RadianceReader(paths, options, warnings).read(paths);
}

}  // namespace enfilade
