#include "import/ifc/ifc_answer.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "base/error.hpp"
#include "import/ifc/floor_outline.hpp"
#include "import/intake/mesh_surfaces.hpp"
#include "import/intake/pane_bodies.hpp"
#include "json/json_text.hpp"
#include "photometry/distribution_json.hpp"

namespace enfilade {
namespace {

using Json = nlohmann::json;

/// Flux that a luminaire sends out over that of its lamp. A distribution in cd/klm integrates to at
/// most 1000 lm (5% allowed for rounding), and one that integrates to less than 10 lm is in cd/lm.
constexpr double least_light_output = 0.01, most_light_output = 1.05;

/// What tells whether faces close a volume: the area vectors of a closed surface that faces one way
/// sum to nothing.
struct Closure {
  Vec3 vectors{0.0};
  double area = 0.0, volume = 0.0;

  void add(const ModelMesh& mesh, const Vec3& origin) {
    for (const IndexLoop& t : mesh.faces) {
      const Vec3 a = mesh.points[t[0]] - origin, b = mesh.points[t[1]] - origin,
                 c = mesh.points[t[2]] - origin;
      const Vec3 twice = glm::cross(b - a, c - a);
      vectors += twice;
      area += glm::length(twice);
      volume += glm::dot(a, glm::cross(b, c)) / 6.0;
    }
  }
  bool closed() const {
    return glm::length(vectors) <= 1e-3 * area &&
           std::abs(volume) >= 1e-6 * std::pow(0.5 * area, 1.5);
  }
};

/// Makes closed bodies face outward; what closes none, neither by itself nor with the other parts
/// of its product, gets two sides.
void turn_outward(std::vector<std::pair<ModelMesh, ModelMaterial>>& parts) {
  const auto turn = [](ModelMesh& mesh) {
    for (IndexLoop& t : mesh.faces) std::reverse(t.begin(), t.end());
  };
  const auto origin_of = [](const ModelMesh& mesh) {
    return mesh.points.empty() ? Vec3(0.0) : mesh.points[0];
  };
  Closure rest;
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    Closure closure;
    closure.add(parts[i].first, origin_of(parts[i].first));
    if (!closure.closed()) {
      open.push_back(i);
      rest.add(parts[i].first, origin_of(parts[open[0]].first));
    } else if (closure.volume < 0.0) {
      turn(parts[i].first);
    }
  }
  for (const std::size_t i : open) {
    parts[i].second.two_sided = !rest.closed();
    if (rest.closed() && rest.volume < 0.0) turn(parts[i].first);
  }
}

Vec3 point_of(const Json& p) { return {p.at(0), p.at(1), p.at(2)}; }

class AnswerReader {
 public:
  AnswerReader(const std::string& path, const ImportOptions& options, Warnings& warnings)
      : options_(options), warnings_(warnings), surfaces_(scene_, warnings) {
    scene_.file = path;
    scene_.bands = 3;
    scene_.unit = ExitanceUnit::lumen_per_m2;
  }

  /// Whatever the program wrote: it ran on a file that may be faulty.
  Scene read(const std::string& answer) {
    try {
      const Json model = Json::parse(answer, nullptr, false);
      if (!model.is_object()) fail("ended its reader within its answer", "import it again");
      return read(model);
    } catch (const Json::exception&) {
      fail("misled its reader: the answer has other parts than it should", "export it anew");
    }
  }

 private:
  Scene read(const Json& model) {
    if (model.contains("fault")) refuse(model);
    for (const Json& warning : model.at("warnings")) warnings_.add(warning.at(0), warning.at(1));
    for (const Json& element : model.at("elements")) add_element(element);
    for (const Json& room : model.at("rooms")) add_room(room);
    for (const Json& portal : model.at("portals")) {
      scene_.building.portals.push_back({portal.at("kind"), portal.at("name"),
                                         box_of(portal.at("box")), portal.at("transmittance")});
    }
    for (const Json& lamp : model.at("luminaires")) add_luminaire(lamp);
    check_shapes(scene_, warnings_);
    return std::move(scene_);
  }

  [[noreturn]] void fail(const std::string& what, const std::string& hint) const {
    throw InputError(scene_.file, "file", what, hint);
  }

  [[noreturn]] void refuse(const Json& answer) const {
    const std::string fault = answer.at("fault");
    if (fault == "malformed") {
      throw InputError(
          scene_.file, "line " + answer.at("line").dump(),
          "entity #" + answer.at("id").dump() + " " + answer.at("what").get<std::string>(),
          "export the model anew");
    }
    if (fault == "no web-ifc") {
      fail("needs web-ifc to be imported, which is not installed",
           "install npm (apt-get install npm), then configure and build Enfilade again");
    }
    if (fault == "no STEP file")
      fail("is no STEP file (ISO 10303-21)", "export it as IFC-SPF, the plain text form");
    if (fault == "no known schema")
      fail("has a schema that is not IFC2x3, IFC4 or IFC4.3", "export it as one of them");
    fail("cannot be read as IFC", "export it anew");
  }

  Box box_of(const Json& corners) const {
    Box box;
    for (const Json& corner : corners) box.add(options_.scale * point_of(corner));
    return box;
  }

  void add_element(const Json& element) {
    if (options_.open_doors && element.at("type").get<std::string>().starts_with("IfcDoor")) return;
    std::vector<std::pair<ModelMesh, ModelMaterial>> parts;
    for (const Json& part : element.at("parts")) {
      auto& [mesh, material] = parts.emplace_back();
      material = material_of(element, part);
      mesh.name = element.at("name");
      mesh.object = element.at("object");
      const Json &points = part.at("points"), &corners = part.at("triangles");
      for (std::size_t i = 0; i + 2 < points.size(); i += 3) {
        mesh.points.push_back(options_.scale * Vec3(points[i].get<double>(),
                                                    points[i + 1].get<double>(),
                                                    points[i + 2].get<double>()));
      }
      for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
        mesh.faces.push_back({corner_of(corners[i], mesh), corner_of(corners[i + 1], mesh),
                              corner_of(corners[i + 2], mesh)});
      }
    }
    turn_outward(parts);
    for (const auto& [mesh, material] : parts) {
      const std::size_t first = scene_.surfaces.size();
      surfaces_.add(mesh, material);
      // An open shape is a sheet of glass, which light passes once.
      if (!material.transmittance.empty() && !material.two_sided)
        merge_pane_bodies(scene_.surfaces, first);
    }
  }

  std::uint32_t corner_of(const Json& corner, const ModelMesh& mesh) const {
    const auto number = corner.get<double>();
    if (!(number >= 0.0 && number < static_cast<double>(mesh.points.size())))
      fail("misled its reader: a triangle of " + in_quotes(mesh.object) + " has no such point",
           "export it anew");
    return static_cast<std::uint32_t>(number);
  }

  ModelMaterial material_of(const Json& element, const Json& part) {
    ModelMaterial material;
    const std::string where = in_quotes(element.at("name").get<std::string>());
    const Json& colour = part.at("colour");
    double passing = 0.0;
    if (colour.is_null()) {
      warnings_.add(where, "has no colour: reflectance taken as 0.5");
    } else {
      material.reflectance = reflectance_of(
          {colour.at(0).get<double>(), colour.at(1).get<double>(), colour.at(2).get<double>()},
          where, warnings_);
      passing = 1.0 - std::clamp(colour.at(3).get<double>(), 0.0, 1.0);
    }
    if (element.contains("reflectance"))
      material.reflectance.assign(3,
                                  std::clamp(element.at("reflectance").get<double>(), 0.0, 0.95));
    const bool told = element.contains("transmittance");
    if (told && (passing > 0.0 || colour.is_null()))
      passing = std::clamp(element.at("transmittance").get<double>(), 0.0, 1.0);
    if (passing > 0.0) {
      material.transmittance.assign(3, passing);
      material.reflectance.assign(3, 0.0);
    }
    return material;
  }

  void add_room(const Json& entry) {
    if (!entry.contains("box")) return;  // the program has told it
    BuildingRoom room{entry.at("name"),
                      entry.at("longName"),
                      entry.at("storey"),
                      box_of(entry.at("box")),
                      {},
                      0.0,
                      0.0};
    const Json& floor = entry.at("floor");
    std::vector<Vec2> corners;
    for (std::size_t i = 0; i + 1 < floor.size(); i += 2)
      corners.emplace_back(options_.scale * floor[i].get<double>(),
                           options_.scale * floor[i + 1].get<double>());
    room.outline = floor_outline(corners);
    room.floor_area_m2 = options_.scale * options_.scale * entry.at("floorArea").get<double>();
    room.required_lx = entry.at("required_lx");
    scene_.building.rooms.push_back(std::move(room));
  }

  void add_luminaire(const Json& entry) {
    BuildingLuminaire lamp{entry.at("name"), entry.at("type"),
                           options_.scale * point_of(entry.at("p")), entry.at("flux_lm")};
    lamp.file = entry.value("file", "");
    if (entry.contains("aim")) {
      lamp.aim = point_of(entry.at("aim"));
      lamp.up = point_of(entry.at("up"));
    }
    if (lamp.flux_lm <= 0.0) {
      warnings_.add("lamp " + in_quotes(lamp.name), "tells no luminous flux: it stays dark");
    } else {
      const double intensity = lamp.flux_lm / (4.0 * std::numbers::pi);
      lamp.light = static_cast<int>(scene_.lights.size());
      scene_.lights.push_back({lamp.p, {intensity, intensity, intensity}});
      scene_.lights.back().name = lamp.name;
      if (entry.contains("distribution")) distribute(entry.at("distribution"), lamp);
    }
    scene_.building.luminaires.push_back(std::move(lamp));
  }

  /// Gives the last light the intensities that the model tells, in candela for 1000 lumens of the
  /// lamp. What is wrong with them costs no more than the distribution.
  void distribute(const Json& told, const BuildingLuminaire& lamp) {
    LightSource& light = scene_.lights.back();
    const std::string where = "lamp " + in_quotes(lamp.name);
    const bool has_axes = glm::length(lamp.aim) > 0.0 && glm::length(lamp.up) > 0.0;
    const auto frame = has_axes ? LightFrame::of(lamp.aim, lamp.up) : std::nullopt;
    try {
      nlohmann::json value = told;
      for (const Json& angles : told.at("angles")) {
        if (angles != told.at("angles").front())
          throw InputError(scene_.file, where, "has planes of different angles",
                           "give all planes the same");
      }
      value["angles"] = told.at("angles").front();
      light.distribution = distribution_from_json(value, scene_.file, where).distribution;
    } catch (const InputError& error) {
      warnings_.add(
          where, "has a light distribution that cannot be used, and shines to all sides alike: " +
                     std::string(error.what()).substr(scene_.file.size() + 2));
      return;
    }
    if (frame) light.frame = *frame;
    const double output = 4.0 * std::numbers::pi * light.distribution->mean() / 1000.0;
    if (output < least_light_output || output > most_light_output) {
      warnings_.add(where, "has intensities of " + shown(std::round(1000.0 * output)) +
                               " lm for 1000 lm of the lamp, "
                               "only their proportions are taken");
      return;
    }
    for (double& intensity : light.intensity) intensity *= output;
  }

  ImportOptions options_;
  Warnings& warnings_;
  Scene scene_;
  MeshSurfaces surfaces_;
};

}  // namespace

Scene scene_from_ifc_answer(const std::string& answer, const std::string& path,
                            const ImportOptions& options, Warnings& warnings) {
  return AnswerReader(path, options, warnings).read(answer);
}

}  // namespace enfilade
