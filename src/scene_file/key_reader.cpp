#include "scene_file/key_reader.hpp"

#include "base/limits.hpp"
#include "json/json_text.hpp"

namespace enfilade {
std::string KeyReader::shown_value(const nlohmann::json& value) { return shown(value); }

Vec3 KeyReader::point(const nlohmann::json& value, const std::string& where) const {
  if (!value.is_array() || value.size() != 3) {
    fail(where, "is " + shown(value) + ", not a point", "write [x, y, z]");
  }
  Vec3 p;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    // The path is put together only for a fault: a building has 10^5 coordinates.
    p[axis] = value[i].is_number() ? value[i].get<double>()
                                   : finite(value[i], where + "[" + std::to_string(i) + "]");
  }
  return p;
}

Vec3 KeyReader::place(const nlohmann::json& value, const std::string& where, double scale) const {
  const Vec3 p = scale * point(value, where);
  if (const auto fault = limits::fault_of_place(p)) fail(where, fault.what, fault.hint);
  return p;
}

Vec3 KeyReader::direction(const nlohmann::json& value, const std::string& where) const {
  const Vec3 v = point(value, where);
  if (const auto fault = limits::fault_of_direction(v)) fail(where, fault.what, fault.hint);
  return limits::unit(v);
}

Spectrum KeyReader::spectrum(const nlohmann::json& value, const std::string& where,
                             double high) const {
  const bool listed = value.is_array();
  if (listed && value.empty()) fail(where, "is an empty list", "write one number, or one per band");
  const std::size_t count = listed ? value.size() : 1;
  if (const auto fault = limits::fault_of_count(count, limits::most_bands, "bands"))
    fail(where, fault.what, fault.hint);
  Spectrum bands;
  for (std::size_t i = 0; i < count; ++i) {
    const nlohmann::json& entry = listed ? value[i] : value;
    const auto place = [&] { return listed ? where + "[" + std::to_string(i) + "]" : where; };
    const double x = entry.is_number() ? entry.get<double>() : finite(entry, place());
    const bool share =
        x >= 0.0 && x < high && high < 1.5;  // a reflectance may be as small as it likes
    if (const auto fault = limits::fault_of_light(x); fault && !share)
      fail(place(), "is " + shown(entry) + ", " + fault.what, fault.hint);
    if (x >= high) {
      if (high > 1.0)
        fail(place(), "is " + shown(entry) + ", outside [0, 1]",
             "a pane passes at most all light: write 0 to 1");
      fail(place(), "is " + shown(entry) + ", outside [0, 1)",
           "a surface reflects less than all light: write 0 to 0.9999");
    }
    bands.push_back(x);
  }
  return bands;
}

std::string KeyReader::text(const nlohmann::json& value, const std::string& where) const {
  if (!value.is_string()) fail(where, "is " + shown(value) + ", not text", "put it in quotes");
  return value.get<std::string>();
}

bool KeyReader::flag(const nlohmann::json& value, const std::string& where) const {
  if (!value.is_boolean())
    fail(where, "is " + shown(value) + ", neither true nor false", "write true or false");
  return value.get<bool>();
}

const nlohmann::json& KeyReader::list(const nlohmann::json& value, const std::string& where) const {
  if (!value.is_array()) fail(where, "is " + shown(value) + ", not a list", "write [...]");
  if (const auto fault = limits::fault_of_count(value.size(), limits::most_items, "entries"))
    fail(where, fault.what, fault.hint);
  return value;
}

const nlohmann::json& KeyReader::need(const nlohmann::json& object, const char* key,
                                      const std::string& where) const {
  if (!object.is_object()) fail(where, "is " + shown(object) + ", not an object", "write {...}");
  const auto it = object.find(key);
  if (it == object.end()) fail(where, std::string("has no \"") + key + "\"", "add it");
  return *it;
}

double KeyReader::metres_per_unit(const nlohmann::json& document) const {
  const auto it = document.find("units");
  if (it == document.end()) return 1.0;
  const std::string unit = text(*it, "units");
  for (const auto& [name, metres] :
       {std::pair{"m", 1.0}, {"cm", 0.01}, {"mm", 0.001}, {"ft", 0.3048}, {"in", 0.0254}}) {
    if (unit == name) return metres;
  }
  fail("units", "is " + in_quotes(unit) + ", not a known unit of length",
       "write one of m, cm, mm, ft, in");
}

std::vector<Probe> KeyReader::probes(const nlohmann::json& document, double scale,
                                     std::set<std::string>* unknown) const {
  std::vector<Probe> probes;
  const auto it = document.find("probes");
  if (it == document.end()) return probes;
  for (std::size_t i = 0; i < list(*it, "probes").size(); ++i) {
    const nlohmann::json& entry = (*it)[i];
    const std::string where = "probes[" + std::to_string(i) + "]";
    Probe probe;
    probe.p = place(need(entry, "p", where), where + ".p", scale);
    probe.n = direction(need(entry, "n", where), where + ".n");
    probes.push_back(probe);
    for (auto key = entry.begin(); unknown != nullptr && key != entry.end(); ++key) {
      if (key.key() != "p" && key.key() != "n") unknown->insert("probes[]." + key.key());
    }
  }
  return probes;
}

}  // namespace enfilade
