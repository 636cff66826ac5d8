#include "app/commands/point_file.hpp"

#include "base/error.hpp"
#include "json/json_text.hpp"
#include "scene_file/key_reader.hpp"

namespace enfilade {

std::vector<Vec3> read_points(const std::string& path) {
  const nlohmann::json document = parse_json(read_text(path), path);
  const KeyReader keys(path);
  const bool probes = document.is_object() && document.contains("probes");
  if (probes && document.contains("points")) {
    throw InputError(path, "top level", "has both points and probes", "keep one of them");
  }
  const std::string key = probes ? "probes" : "points";
  const nlohmann::json& list = document.is_array()
                                   ? document
                                   : keys.list(keys.need(document, key.c_str(), "top level"), key);
  const double scale = document.is_object() ? keys.metres_per_unit(document) : 1.0;
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string where = key + "[" + std::to_string(i) + "]";
    const nlohmann::json& item = list[i];
    const nlohmann::json& p = item.is_object() ? keys.need(item, "p", where) : item;
    points.push_back(keys.place(p, where, scale));
  }
  return points;
}

}  // namespace enfilade
