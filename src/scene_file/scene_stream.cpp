#include "scene_file/scene_stream.hpp"

#include <array>
#include <charconv>
#include <nlohmann/json.hpp>
#include <utility>

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
void append_text(std::string& text, const std::string& value) {
  text += ordered_json(value).dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

void append_surface(std::string& text, const Surface& surface) {
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
        {",\"object\":", surface.object}}) {
    if (value.empty()) continue;
    text += key;
    append_text(text, value);
  }
  if (surface.two_sided) text += ",\"two_sided\":true";
  text += '}';
}

void append_light(std::string& text, const PointLight& light) {
  text += "{\"type\":\"point\",\"p\":";
  append_point(text, light.p);
  text += ",\"intensity\":";
  append_spectrum(text, light.intensity);
  text += '}';
}

void append_probe(std::string& text, const Probe& probe) {
  text += "{\"p\":";
  append_point(text, probe.p);
  text += ",\"n\":";
  append_point(text, probe.n);
  text += '}';
}

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

SceneStream::SceneStream(std::string path, ExitanceUnit unit) : file_(std::move(path)) {
  text_ =
      "{\"format\": \"enfilade-scene\", \"version\": 1, \"units\": \"m\", \"exitanceUnits\": \"";
  text_ += std::string(name_of(unit)) + "\"";
}

void SceneStream::add(const Surface& surface) {
  text_ += any_surface_ ? ",\n  " : ",\n \"surfaces\": [\n  ";
  any_surface_ = true;
  append_surface(text_, surface);
  if (text_.size() >= flush_bytes) flush();
}

void SceneStream::finish(const std::vector<PointLight>& lights, const std::vector<Probe>& probes) {
  if (any_surface_) text_ += "\n ]";
  append_list(text_, "lights", lights, append_light);
  append_list(text_, "probes", probes, append_probe);
  text_ += "\n}\n";
  flush();
  file_.commit(true);
}

void SceneStream::flush() {
  file_.add(text_);
  text_.clear();
}

}  // namespace enfilade
