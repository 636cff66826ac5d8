#include "app/commands/glare_place_file.hpp"

#include "base/error.hpp"
#include "json/json_text.hpp"
#include "scene_file/key_reader.hpp"

namespace enfilade {

std::vector<GlarePlace> read_glare_places(const std::string& path) {
  const nlohmann::json document = parse_json(read_text(path), path);
  const KeyReader keys(path);
  const bool probes = document.is_object() && document.contains("probes");
  const std::string key = probes ? "probes" : "places";
  const nlohmann::json& list = keys.list(keys.need(document, key.c_str(), "top level"), key);
  const double scale = keys.metres_per_unit(document);
  std::vector<GlarePlace> places;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string where = key + "[" + std::to_string(i) + "]";
    const nlohmann::json& entry = list[i];
    GlarePlace place;
    place.p = keys.place(keys.need(entry, "p", where), where + ".p", scale);
    const char* direction = entry.contains("direction") || !entry.contains("n") ? "direction" : "n";
    place.direction = keys.direction(keys.need(entry, direction, where), where + "." + direction);
    place.name = entry.contains("name") ? keys.text(entry["name"], where + ".name")
                                        : "place " + std::to_string(i + 1);
    places.push_back(std::move(place));
  }
  if (places.empty()) {
    throw InputError(path, key, "is empty",
                     "name a place, as in {\"p\": [1, 2, 1.2], \"direction\": [1, 0, 0]}");
  }
  return places;
}

}  // namespace enfilade
