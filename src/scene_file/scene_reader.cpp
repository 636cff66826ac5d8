// Reads the JSON scene; the format is described in scenes/scene.schema.json.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string_view>

#include "base/checksum.hpp"
#include "json/json_text.hpp"
#include "scene/scene_limits.hpp"
#include "scene_file/key_reader.hpp"
#include "scene_file/light_reader.hpp"
#include "scene_file/room_reader.hpp"
#include "scene_file/scene_io.hpp"
#include "scene_file/sky_reader.hpp"

namespace enfilade {
namespace {

using nlohmann::json;

/// Keys of the top level. Those of the last two rows describe the building and where the model
/// comes from; the solver has no use for them. Models are taken with z up, so "up" may say "z".
constexpr std::array<std::string_view, 22> known_keys{
    "sky",     "distributions", "format",        "version", "units",  "surfaces",
    "lights",  "probes",        "exitanceUnits", "up",      "rooms",  "doors",
    "portals", "luminaires",    "offset_m",      "tool",    "source", "licence",
    "license", "attribution",   "copyright",     "author"};

/// The least number that is no transmittance.
const double above_one = std::nextafter(1.0, 2.0);

class SceneReader {
 public:
  SceneReader(const std::string& path, bool allow_outside, Warnings& warnings)
      : keys_(path), allow_outside_(allow_outside), warnings_(warnings) {}

  Scene read(std::string text) {
    json document = parse_json(text, keys_.file());
    scene_.file = keys_.file();
    read_head(document);
    DistributionSource distributions(keys_, document, warnings_, allow_outside_);
    LightReader lights(
        keys_, distributions, scale_,
        [this](const Spectrum& light, const std::string& where) { note_bands(light, where); },
        unknown_, warnings_);
    const json& surfaces = keys_.list(keys_.need(document, "surfaces", "top level"), "surfaces");
    if (surfaces.empty())
      keys_.fail("surfaces", "is an empty list", "a scene needs at least one surface");
    scene_.surfaces.reserve(surfaces.size());
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
      const std::string where = read_surface(surfaces[i], i);
      if (!surfaces[i].contains("distribution")) continue;
      lights.read_distribution(document["surfaces"][i], where, scene_.unit, scene_.surfaces.back());
    }
    lights.read_lights(document, scene_);
    lights.read_luminaires(document, scene_);
    if (document.contains("sky")) {
      scene_.sky = read_sky(
          keys_, document["sky"],
          [this](const Spectrum& light, const std::string& where) { note_bands(light, where); },
          unknown_);
    }
    scene_.probes = keys_.probes(document, scale_, &unknown_);
    scene_.building.rooms = read_rooms(keys_, document, scale_, unknown_);
    broadcast();
    check_limits(scene_);
    warn();
    // A copy of the scene must need no other file, and its hash tell all that it says.
    if (distributions.changed()) text = document.dump(1);
    scene_.hash = checksum(text);
    scene_.text = std::move(text);
    return std::move(scene_);
  }

 private:
  void read_head(const json& document) {
    if (!document.is_object())
      keys_.fail("top level", "is not an object", "write {\"surfaces\": [...]}");
    for (auto it = document.begin(); it != document.end(); ++it) {
      const std::string& key = it.key();
      if (key == "format" && *it != "enfilade-scene") {
        keys_.fail(key, "is " + shown(*it) + ", not a scene",
                   "write \"enfilade-scene\" or give a scene file");
      } else if (key == "version" && *it != 1) {
        keys_.fail(key, "is " + shown(*it) + ", which this program does not know",
                   "write version 1");
      } else if (key == "exitanceUnits") {
        read_unit(*it);
      } else if (key == "up" && *it != "z") {
        unknown_.insert(key);
      } else if (std::ranges::find(known_keys, key) == known_keys.end()) {
        unknown_.insert(key);
      }
    }
    scale_ = keys_.metres_per_unit(document);
  }

  void read_unit(const json& value) {
    const std::string unit = keys_.text(value, "exitanceUnits");
    if (unit == "lm/m2")
      scene_.unit = ExitanceUnit::lumen_per_m2;
    else if (unit != "W/m2")
      keys_.fail("exitanceUnits", "is " + in_quotes(unit), "write \"W/m2\" or \"lm/m2\"");
  }

  /// Returns where it stands, for messages.
  std::string read_surface(const json& entry, std::size_t index) {
    Surface surface;
    std::string where = "surfaces[" + std::to_string(index) + "]";
    const json& vertices = keys_.need(entry, "vertices", where);
    if (entry.contains("name")) surface.name = keys_.text(entry["name"], where + ".name");
    if (!surface.name.empty()) where.append(" ").append(in_quotes(surface.name));
    for (auto it = entry.begin(); it != entry.end(); ++it) {
      const std::string& key = it.key();
      if (key == "reflectance") {
        surface.reflectance = keys_.spectrum(*it, where + ".reflectance", 1.0);
        note_bands(surface.reflectance, where + ".reflectance");
      } else if (key == "exitance") {
        surface.exitance =
            keys_.spectrum(*it, where + ".exitance", std::numeric_limits<double>::infinity());
        note_bands(surface.exitance, where + ".exitance");
      } else if (key == "transmittance") {
        surface.transmittance = keys_.spectrum(*it, where + ".transmittance", above_one);
        note_bands(surface.transmittance, where + ".transmittance");
      } else if (key == "object") {
        surface.object = keys_.text(*it, where + ".object");
      } else if (key == "switch") {
        surface.switch_name = keys_.text(*it, where + ".switch");
      } else if (key == "two_sided") {
        surface.two_sided = keys_.flag(*it, where + ".two_sided");
      } else if (key != "vertices" && key != "name" && key != "distribution" && key != "up") {
        unknown_.insert("surfaces[]." + key);
      }
    }
    if (surface.reflectance.empty()) warnings_.add(where, "has no reflectance: taken as 0 (black)");
    read_vertices(vertices, where + ".vertices", surface.vertices);
    scene_.surfaces.push_back(std::move(surface));
    return where;
  }

  void read_vertices(const json& vertices, const std::string& where, Polygon& polygon) {
    if (keys_.list(vertices, where).size() < 3) {
      keys_.fail(where, "has " + std::to_string(vertices.size()) + " points",
                 "a polygon needs 3 or more");
    }
    polygon.reserve(vertices.size());
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const json& v = vertices[i];
      const bool fine =
          v.is_array() && v.size() == 3 && v[0].is_number() && v[1].is_number() && v[2].is_number();
      polygon.push_back(scale_ *
                        (fine ? Vec3(v[0].get<double>(), v[1].get<double>(), v[2].get<double>())
                              : keys_.point(v, where + "[" + std::to_string(i) + "]")));
    }
  }

  // The first list of more than one value says how many bands the scene has; single values fit any
  // number.
  void note_bands(const Spectrum& spectrum, const std::string& where) {
    const int bands = static_cast<int>(spectrum.size());
    if (bands <= 1 || bands == scene_.bands) return;
    if (scene_.bands != 1) {
      keys_.fail(where,
                 "has " + std::to_string(bands) + " bands, but " + bands_from_ + " has " +
                     std::to_string(scene_.bands),
                 "write one number, or the same number of bands everywhere");
    }
    scene_.bands = bands;
    bands_from_ = where;
  }

  void broadcast() {
    const auto fill = [this](Spectrum& s) {
      const double value = s.empty() ? 0.0 : s[0];
      if (s.size() <= 1) s.assign(static_cast<std::size_t>(scene_.bands), value);
    };
    for (Surface& surface : scene_.surfaces) {
      fill(surface.reflectance);
      fill(surface.exitance);
      if (surface.is_pane()) fill(surface.transmittance);
      if (std::ranges::all_of(surface.transmittance, [](double t) { return t <= 0.0; }))
        surface.transmittance.clear();
    }
    for (LightSource& light : scene_.lights) fill(light.intensity);
    if (!scene_.sky) return;
    fill(scene_.sky->zenith_luminance);
    if (!scene_.sky->sun_illuminance.empty()) fill(scene_.sky->sun_illuminance);
    if (!scene_.sky->ground_reflectance.empty()) fill(scene_.sky->ground_reflectance);
  }

  void warn() {
    if (unknown_.empty()) return;
    std::string keys;
    for (const std::string& key : unknown_) keys += (keys.empty() ? "" : ", ") + key;
    warnings_.add(keys, "unknown keys, ignored");
  }

  KeyReader keys_;
  bool allow_outside_;
  Warnings& warnings_;
  Scene scene_;
  double scale_ = 1.0;
  std::string bands_from_;
  std::set<std::string> unknown_;
};

}  // namespace

Scene read_scene(const std::string& path, Warnings& warnings, bool allow_outside) {
  return SceneReader(path, allow_outside, warnings).read(read_text(path));
}

Scene scene_from(std::string text, const std::string& path, Warnings& warnings) {
  return SceneReader(path, false, warnings).read(std::move(text));
}

}  // namespace enfilade
