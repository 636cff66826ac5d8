#include "scene_file/sky_reader.hpp"

#include <limits>
#include <numbers>

#include "json/json_text.hpp"

namespace enfilade {
namespace {

using nlohmann::json;
constexpr double no_limit = std::numeric_limits<double>::infinity();
constexpr double degree = std::numbers::pi / 180.0;

SkyShape shape_of(const KeyReader& keys, const json& value) {
  const char* const hint = "write \"overcast\", \"clear\", \"uniform\" or a number from 1 to 15";
  if (value.is_number_integer()) {
    const auto type = value.get<std::int64_t>();
    if (type < 1 || type > 15) keys.fail("sky.type", "is " + shown(value), hint);
    return SkyShape::of_type(static_cast<int>(type));
  }
  const std::string name = value.is_string() ? value.get<std::string>() : "";
  SkyShape shape;
  if (name == "overcast") {
    shape.overcast = true;
    return shape;
  }
  if (name == "clear") return SkyShape::of_type(12);
  if (name == "uniform") return SkyShape::of_type(5);
  keys.fail("sky.type", "is " + shown(value), hint);
}

class SkyReader {
 public:
  using NoteBands = std::function<void(const Spectrum&, const std::string&)>;
  SkyReader(const KeyReader& keys, const json& value, const NoteBands& note_bands)
      : keys_(keys), value_(value), note_bands_(note_bands) {}

  Sky read() {
    if (!value_.is_object())
      keys_.fail("sky", "is not an object", "write {\"type\": \"overcast\", ...}");
    Sky sky;
    sky.shape = shape_of(keys_, keys_.need(value_, "type", "sky"));
    if (value_.contains("up")) sky.zenith = keys_.direction(value_["up"], "sky.up");
    read_sun(sky);
    if (value_.contains("ground_reflectance"))
      sky.ground_reflectance = bands("ground_reflectance", 1.0);
    const bool zenith = value_.contains("zenith"),
               plane = value_.contains("horizontal_illuminance");
    if (zenith == plane) {
      keys_.fail("sky", zenith ? "has a zenith and a horizontal_illuminance" : "has no brightness",
                 "write either its \"zenith\" (luminance) or its \"horizontal_illuminance\"");
    }
    sky.zenith_luminance = bands(zenith ? "zenith" : "horizontal_illuminance", no_limit);
    if (!plane) return sky;
    const double per_zenith = sky.horizontal_per_zenith();
    for (double& band : sky.zenith_luminance) band /= per_zenith;
    return sky;
  }

 private:
  Spectrum bands(const char* key, double high) {
    const std::string where = std::string("sky.") + key;
    Spectrum spectrum = keys_.spectrum(value_[key], where, high);
    note_bands_(spectrum, where);
    return spectrum;
  }

  void read_sun(Sky& sky) {
    if (!value_.contains("sun")) {
      if (sky.shape.needs_sun()) {
        keys_.fail("sky", "of this type has no sun",
                   "write \"sun\": {\"elevation\": degrees, \"azimuth\": degrees from north}");
      }
      return;
    }
    const json& sun = value_["sun"];
    if (!sun.is_object())
      keys_.fail("sky.sun", "is not an object", "write {\"elevation\": 40, \"azimuth\": 180}");
    const double elevation =
        keys_.finite(keys_.need(sun, "elevation", "sky.sun"), "sky.sun.elevation");
    const double azimuth = keys_.finite(keys_.need(sun, "azimuth", "sky.sun"), "sky.sun.azimuth");
    if (elevation < 0.0 || elevation > 90.0)
      keys_.fail("sky.sun.elevation", "is " + shown(sun["elevation"]) + ", outside [0, 90]",
                 "write the angle above the horizon in degrees");
    const Vec3 north = value_.contains("north") ? keys_.direction(value_["north"], "sky.north")
                                                : Vec3(0.0, 1.0, 0.0);
    const Vec3 level = north - glm::dot(north, sky.zenith) * sky.zenith;
    if (glm::length(level) < 1e-6)
      keys_.fail("sky.north", "points up", "write a horizontal direction");
    const Vec3 ahead = glm::normalize(level), east = glm::cross(ahead, sky.zenith);
    const double turn = azimuth * degree, height = elevation * degree;
    sky.sun = std::sin(height) * sky.zenith +
              std::cos(height) * (std::cos(turn) * ahead + std::sin(turn) * east);
    if (!sun.contains("illuminance")) return;
    sky.sun_illuminance = keys_.spectrum(sun["illuminance"], "sky.sun.illuminance", no_limit);
    note_bands_(sky.sun_illuminance, "sky.sun.illuminance");
  }

  const KeyReader& keys_;
  const json& value_;
  const NoteBands& note_bands_;
};

void note_unknown(const json& object, const std::string& where,
                  std::initializer_list<std::string_view> known, std::set<std::string>& unknown) {
  for (auto it = object.begin(); it != object.end(); ++it) {
    if (std::find(known.begin(), known.end(), it.key()) == known.end())
      unknown.insert(where + "." + it.key());
  }
}

}  // namespace

Sky read_sky(const KeyReader& keys, const json& value,
             const std::function<void(const Spectrum&, const std::string& where)>& note_bands,
             std::set<std::string>& unknown) {
  Sky sky = SkyReader(keys, value, note_bands).read();
  note_unknown(
      value, "sky",
      {"type", "zenith", "horizontal_illuminance", "sun", "north", "up", "ground_reflectance"},
      unknown);
  if (value.contains("sun"))
    note_unknown(value["sun"], "sky.sun", {"elevation", "azimuth", "illuminance"}, unknown);
  return sky;
}

}  // namespace enfilade
