#include "scene_file/scene_stream.hpp"

#include <array>
#include <charconv>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>

#include "scene/photopic.hpp"

namespace enfilade {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t flush_bytes = std::size_t{1} << 20;

// The shortest digits that read back as the same number.
void append(std::string& text, double x) {
  char digits[32];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, x).ptr);
}

template <class Numbers>
void append_numbers(std::string& text, const Numbers& numbers, int count) {
  text += '[';
  for (int i = 0; i < count; ++i) {
    if (i > 0) text += ',';
    append(text, numbers[static_cast<typename Numbers::size_type>(i)]);
  }
  text += ']';
}

void append_point(std::string& text, const Vec3& p) {
  append_numbers(text, std::array<double, 3>{p.x, p.y, p.z}, 3);
}
void append_spectrum(std::string& text, const Spectrum& s) {
  append_numbers(text, s, static_cast<int>(s.size()));
}
void append_key(std::string& text, const char* key, const Vec3& p) {
  text += std::string(",\"") + key + "\":";
  append_point(text, p);
}
void append_key(std::string& text, const char* key, const Spectrum& s) {
  text += std::string(",\"") + key + "\":";
  append_spectrum(text, s);
}
void append_text(std::string& text, const ordered_json& value) {
  text += value.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

void append_surface(std::string& text, const Surface& surface, DistributionNames& names) {
  text += "{\"vertices\":[";
  for (std::size_t i = 0; i < surface.vertices.size(); ++i) {
    if (i > 0) text += ',';
    append_point(text, surface.vertices[i]);
  }
  text += "],\"reflectance\":";
  append_spectrum(text, surface.reflectance);
  text += ",\"exitance\":";
  append_spectrum(text, surface.exitance);
  for (const auto& [key, value] :
       {std::pair<const char*, const std::string&>{",\"name\":", surface.name},
        {",\"object\":", surface.object},
        {",\"switch\":", surface.switch_name}}) {
    if (value.empty()) continue;
    text += key;
    append_text(text, value);
  }
  if (surface.two_sided) text += ",\"two_sided\":true";
  if (surface.distribution) {
    text += ",\"distribution\":\"" + names.of(surface.distribution, {}) + "\"";
    if (surface.up != Vec3(0.0)) append_key(text, "up", surface.up);
  }
  text += '}';
}

bool is_luminaire(const LightSource& light) {
  return (light.distribution && !light.cone) || light.shape.shape != OpeningShape::point;
}

Spectrum times(const Spectrum& light, double factor) {
  Spectrum product = light;
  for (double& band : product) band *= factor;
  return product;
}

void append_name(std::string& text, const LightSource& light) {
  for (const auto& [key, value] : {std::pair<const char*, const std::string&>{"name", light.name},
                                   {"switch", light.switch_name}}) {
    if (value.empty()) continue;
    text += std::string(",\"") + key + "\":";
    append_text(text, value);
  }
}

/// A point or a spot light; of the latter the intensity on its axis, and the flux.
void append_light(std::string& text, const LightSource& light) {
  text += light.cone ? "{\"type\":\"spot\"" : "{\"type\":\"point\"";
  append_key(text, "p", light.p);
  if (light.cone) {
    append_key(text, "direction", light.frame.aim);
    append_key(text, "intensity",
               times(light.intensity, light.distribution->peak() / light.distribution->mean()));
    text += ",\"innerConeAngle\":";
    append(text, light.cone->inner);
    text += ",\"outerConeAngle\":";
    append(text, light.cone->outer);
    append_key(text, "flux", times(light.intensity, 4.0 * std::numbers::pi));
  } else {
    append_key(text, "intensity", light.intensity);
  }
  append_name(text, light);
  text += '}';
}

/// Its flux in lumens, whatever the scene's unit.
void append_lit_luminaire(std::string& text, const LightSource& light, ExitanceUnit unit,
                          DistributionNames& names) {
  text += "{\"p\":";
  append_point(text, light.p);
  append_key(text, "aim", light.frame.aim);
  append_key(text, "up", light.frame.up);
  append_key(text, "flux", times(light.intensity, 4.0 * std::numbers::pi / per_lumen(unit)));
  if (light.distribution) {
    text += ",\"distribution\":\"" + names.of(light.distribution, light.shape) + "\"";
  } else {
    append_key(text, "size", light.shape.size);
  }
  append_name(text, light);
  text += '}';
}

void append_probe(std::string& text, const Probe& probe) {
  text += "{\"p\":";
  append_point(text, probe.p);
  text += ",\"n\":";
  append_point(text, probe.n);
  text += '}';
}

ordered_json corners(const Box& box) {
  return {{box.lo.x, box.lo.y, box.lo.z}, {box.hi.x, box.hi.y, box.hi.z}};
}

void append_room(std::string& text, const BuildingRoom& room) {
  ordered_json entry{{"name", room.name}, {"longName", room.long_name}, {"storey", room.storey}};
  entry["bbox"] = corners(room.box);
  for (const Vec2& p : room.outline) entry["outline"].push_back({p.x, p.y});
  if (!room.outline.empty()) entry["z"] = {room.box.lo.z, room.box.hi.z};
  if (room.floor_area_m2 > 0.0) entry["floorArea"] = room.floor_area_m2;
  entry["height"] = room.box.extent().z;
  if (room.required_lx > 0.0) entry["required_lx"] = room.required_lx;
  append_text(text, entry);
}

void append_portal(std::string& text, const BuildingPortal& portal) {
  ordered_json entry{{"kind", portal.kind}, {"name", portal.name}, {"bbox", corners(portal.box)}};
  if (portal.transmittance >= 0.0) entry["transmittance"] = portal.transmittance;
  append_text(text, entry);
}

void append_luminaire(std::string& text, const BuildingLuminaire& lamp) {
  ordered_json entry{
      {"name", lamp.name}, {"type", lamp.type}, {"p", {lamp.p.x, lamp.p.y, lamp.p.z}}};
  if (lamp.flux_lm > 0.0) entry["flux_lm"] = lamp.flux_lm;
  append_text(text, entry);
}

/// An entry of the "luminaires": one that gives light, or a fixture of the building.
struct Luminaire {
  const LightSource* light;
  const BuildingLuminaire* fixture;
};

// One entry a line: files that people can read and compare.
template <class Items, class Append>
void append_list(std::string& text, const char* key, const Items& items, Append append_item) {
  if (items.empty()) return;
  text += std::string(",\n \"") + key + "\": [";
  for (std::size_t i = 0; i < items.size(); ++i) {
    text += i == 0 ? "\n  " : ",\n  ";
    append_item(text, items[i]);
  }
  text += "\n ]";
}

}  // namespace

SceneStream::SceneStream(std::string path, ExitanceUnit unit)
    : file_(std::move(path)), unit_(unit) {
  text_ =
      "{\"format\": \"enfilade-scene\", \"version\": 1, \"units\": \"m\", \"exitanceUnits\": \"";
  text_ += std::string(name_of(unit)) + "\"";
}

void SceneStream::add(const Surface& surface) {
  text_ += any_surface_ ? ",\n  " : ",\n \"surfaces\": [\n  ";
  any_surface_ = true;
  append_surface(text_, surface, distributions_);
  if (text_.size() >= flush_bytes) flush();
}

void SceneStream::finish(const std::vector<LightSource>& lights, const std::vector<Probe>& probes,
                         const BuildingData& building) {
  if (any_surface_) text_ += "\n ]";
  std::vector<LightSource> plain;
  std::vector<Luminaire> luminaires;
  for (const LightSource& light : lights) {
    if (is_luminaire(light))
      luminaires.push_back({&light, nullptr});
    else
      plain.push_back(light);
  }
  for (const BuildingLuminaire& lamp : building.luminaires) luminaires.push_back({nullptr, &lamp});
  append_list(text_, "lights", plain, append_light);
  append_list(text_, "probes", probes, append_probe);
  append_list(text_, "rooms", building.rooms, append_room);
  append_list(text_, "portals", building.portals, append_portal);
  append_list(text_, "luminaires", luminaires, [&](std::string& text, const Luminaire& entry) {
    if (entry.light != nullptr)
      append_lit_luminaire(text, *entry.light, unit_, distributions_);
    else
      append_luminaire(text, *entry.fixture);
  });
  distributions_.append_to(text_);
  text_ += "\n}\n";
  flush();
  file_.commit(true);
}

void SceneStream::flush() {
  file_.add(text_);
  text_.clear();
}

}  // namespace enfilade
