#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/limits.hpp"
#include "json/json_text.hpp"
#include "report/pictures/camera.hpp"

namespace enfilade {

namespace {

using Json = nlohmann::json;

[[noreturn]] void refuse(const std::string& path, const std::string& where,
                         const std::string& what) {
  throw InputError(path, where, what,
                   R"(write {"cameras": [{"name": "hall", "eye": [x,y,z], "look_at": [x,y,z]}]})");
}

Vec3 vector_of(const Json& json, const std::string& path, const std::string& where) {
  const bool three = json.is_array() && json.size() == 3 && json[0].is_number() &&
                     json[1].is_number() && json[2].is_number();
  if (!three) refuse(path, where, "three numbers are expected");
  return {json[0].get<double>(), json[1].get<double>(), json[2].get<double>()};
}

double positive(const Json& json, const std::string& path, const std::string& where) {
  if (!json.is_number() || !(json.get<double>() > 0.0))
    refuse(path, where, "a positive number is expected");
  return json.get<double>();
}

Camera camera_of(const Json& json, const std::string& path, std::size_t index) {
  const std::string where = "cameras[" + std::to_string(index) + "]";
  if (!json.is_object()) refuse(path, where, "an object is expected");
  for (const char* key : {"eye", "look_at"}) {
    if (!json.contains(key)) refuse(path, where, std::string("'") + key + "' is missing");
  }
  Camera camera;
  camera.name = "camera-" + std::to_string(index + 1);
  for (const auto& [key, value] : json.items()) {
    const std::string at = where + "." + key;
    if (key == "name" && value.is_string()) camera.name = value.get<std::string>();
    if (key == "eye") camera.eye = vector_of(value, path, at);
    if (key == "look_at") camera.look_at = vector_of(value, path, at);
    if (key == "up") camera.up = vector_of(value, path, at);
    if (key == "vertical_angle_deg") camera.vertical_angle_deg = positive(value, path, at);
    if (key == "parallel_height_m") camera.parallel_height_m = positive(value, path, at);
    if (key == "cut_above_m") {
      if (!value.is_number()) refuse(path, at, "a number is expected");
      camera.cut_above_m = value.get<double>();
    }
  }
  check_camera(camera, path, where + ".");
  return camera;
}

}  // namespace

void check_camera(Camera& camera, const std::string& file, const std::string& where) {
  const auto need = [&](const char* name, const limits::Fault& fault) {
    if (!fault) return;
    std::string key = where + name;
    if (where == "--") std::replace(key.begin(), key.end(), '_', '-');
    throw InputError(file, key, fault.what, fault.hint);
  };
  const auto need_length = [&](const char* name, double length, double least) {
    if (std::abs(length) <= limits::farthest_m && length >= least) return;
    need(name, {"is no length from 1e-6 to 1e9 m", "check the number and its unit"});
  };
  need("eye", limits::fault_of_place(camera.eye));
  need("look_at", limits::fault_of_place(camera.look_at));
  need("up", limits::fault_of_direction(camera.up));
  camera.up = limits::unit(camera.up);
  if (!(glm::length(camera.look_at - camera.eye) >= limits::smallest_extent_m))
    need("look_at", {"is where the eye is", "look at another point"});
  if (!(camera.vertical_angle_deg >= 1e-3 && camera.vertical_angle_deg < 180.0))
    need("vertical_angle_deg", {"is no angle of view", "give 0.001 to 179 degrees"});
  if (camera.parallel_height_m != 0.0)
    need_length("parallel_height_m", camera.parallel_height_m, limits::smallest_extent_m);
  if (camera.cut_above_m) need_length("cut_above_m", *camera.cut_above_m, -limits::farthest_m);
}

std::vector<Camera> read_cameras(const std::string& path) {
  const Json json = parse_json(read_text(path), path);
  if (!json.is_object() || !json.contains("cameras") || !json["cameras"].is_array()) {
    refuse(path, "cameras", "a list is expected");
  }
  std::vector<Camera> cameras;
  for (const Json& item : json["cameras"]) cameras.push_back(camera_of(item, path, cameras.size()));
  if (cameras.empty()) refuse(path, "cameras", "the list is empty");
  return cameras;
}

}  // namespace enfilade
