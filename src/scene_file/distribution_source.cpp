#include "scene_file/distribution_source.hpp"

#include "json/json_text.hpp"

namespace enfilade {

using nlohmann::json;

DistributionSource::DistributionSource(const KeyReader& keys, json& document, Warnings& warnings,
                                       bool allow_outside)
    : keys_(keys), document_(document), warnings_(warnings), files_(keys.file(), allow_outside) {}

const DistributionSource::Found* DistributionSource::find(json& entry, const std::string& where) {
  if (entry.contains("file")) {
    if (entry.contains("distribution"))
      keys_.fail(where, "has both \"file\" and \"distribution\"", "leave one of them out");
    const std::string name = keys_.text(entry["file"], where + ".file");
    const Found& found = of_file(name, where + ".file");
    entry.erase("file");
    entry["distribution"] = name;
    return &found;
  }
  const auto it = entry.find("distribution");
  if (it == entry.end()) return nullptr;
  const std::string key = where + ".distribution";
  if (it->is_string()) return &named(it->get<std::string>(), key);
  unnamed_.push_back(
      std::make_unique<Found>(Found{distribution_from_json(*it, keys_.file(), key), LampTilt{}}));
  return unnamed_.back().get();
}

/// A table of the document, or a photometric file of that name.
const DistributionSource::Found& DistributionSource::named(const std::string& name,
                                                           const std::string& where) {
  if (const auto known = by_name_.find(name); known != by_name_.end()) return known->second;
  const auto tables = document_.find("distributions");
  if (tables != document_.end() && tables->is_object() && tables->contains(name)) {
    const InlineDistribution light =
        distribution_from_json((*tables)[name], keys_.file(), "distributions." + name);
    return by_name_.emplace(name, Found{light, {}}).first->second;
  }
  if (is_photometric_file(name)) return of_file(name, where);
  keys_.fail(where, "is " + in_quotes(name) + ", which is not among \"distributions\"",
             "write its table there, or name a photometric file (.ies, .ldt)");
}

const DistributionSource::Found& DistributionSource::of_file(const std::string& name,
                                                             const std::string& where) {
  if (const auto known = by_name_.find(name); known != by_name_.end()) return known->second;
  const std::string path = ModelFiles::path_from(keys_.file(), name);
  const ModelFiles::Place place{keys_.file(), where};
  const std::string& bytes = files_.read(path, place);
  const auto beside = [&](const std::string& side) -> std::optional<std::string> {
    const std::string file = ModelFiles::path_from(path, side);
    if (!files_.allowed(file) || !ModelFiles::exists(file)) return std::nullopt;
    return files_.read(file, place);
  };
  const PhotometricFile read = read_photometric_file(bytes, path, warnings_, beside);
  const Found found{{read.distribution, read.opening}, read.tilt};
  document_["distributions"][name] = to_json(found.light);
  changed_ = true;
  return by_name_.emplace(name, found).first->second;
}

}  // namespace enfilade
