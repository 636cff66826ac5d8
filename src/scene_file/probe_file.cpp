// Probe files: a list of points, and the same list with answers.
#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "json/json_text.hpp"
#include "scene_file/key_reader.hpp"
#include "scene_file/probe_table.hpp"
#include "scene_file/scene_io.hpp"

namespace enfilade {

ProbeFile read_probes(const std::string& path) {
  ProbeFile file{path, read_text(path), {}};
  if (is_table(path)) return read_probe_table(std::move(file));
  const nlohmann::json document = parse_json(file.text, path);
  const KeyReader keys(path);
  keys.list(keys.need(document, "probes", "top level"), "probes");
  file.probes = keys.probes(document, keys.metres_per_unit(document), nullptr);
  if (file.probes.empty())
    throw InputError(path, "probes", "is empty", "name a point, as in {\"p\": [0, 0, 1]}");
  return file;
}

void write_probe_answers(const ProbeFile& source, const std::string& path,
                         const std::vector<ProbeAnswer>& answers, const std::string& from,
                         ExitanceUnit unit) {
  ENFILADE_CHECK(
      source.probes.size() == answers.size(),
      std::to_string(source.probes.size()) + " probes, " + std::to_string(answers.size()));
  if (is_table(path)) {
    write_file_atomically(path, probe_table(source, answers, from, irradiance_label(unit)));
    return;
  }
  nlohmann::ordered_json document = source.table.columns.empty()
                                        ? parse_ordered_json(source.text, source.path)
                                        : json_of_table(source);
  // Where the probes came with a scene, its geometry is no part of the answer.
  document.erase("surfaces");
  for (const char* key : {"lights", "luminaires", "distributions"}) document.erase(key);
  // All light in the answer is in the unit of the run.
  if (document.contains("exitanceUnits")) document["exitanceUnits"] = name_of(unit);
  document["from"] = from;
  document["unit"] = irradiance_label(unit);
  nlohmann::ordered_json& probes = document["probes"];
  for (std::size_t i = 0; i < answers.size(); ++i) {
    probes[i]["E"] = answers[i].irradiance;
    probes[i]["error"] = answers[i].error;
    if (!answers[i].daylight_factor.empty())
      probes[i]["daylight_factor"] = answers[i].daylight_factor;
    for (const auto& [name, light] : answers[i].shares) probes[i]["shares"][name] = light;
  }
  write_file_atomically(
      path, document.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

}  // namespace enfilade
