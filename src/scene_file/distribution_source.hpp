// Where the distributions of a scene file come from: its own tables, or photometric files beside
// it.
#pragma once

#include <map>
#include <memory>

#include "json/model_files.hpp"
#include "photometry/distribution_json.hpp"
#include "photometry/files/photometric_file.hpp"
#include "scene_file/key_reader.hpp"

namespace enfilade {

/// Each file is read once. What was read from files can be put into the document, so that a copy
/// of it needs no other file.
class DistributionSource {
 public:
  /// `document`: the whole scene file, with its "distributions" by name.
  DistributionSource(const KeyReader& keys, nlohmann::json& document, Warnings& warnings,
                     bool allow_outside);

  struct Found {
    InlineDistribution light;
    LampTilt tilt;
  };
  /// Returns the distribution under "distribution" (a table, or the name of one) or "file" of an
  /// entry; null where it has neither. A file's is put into the document: under "distributions",
  /// with its name in the entry.
  const Found* find(nlohmann::json& entry, const std::string& where);
  /// True where the document was changed.
  bool changed() const { return changed_; }

 private:
  const Found& named(const std::string& name, const std::string& where);
  const Found& of_file(const std::string& name, const std::string& where);

  const KeyReader& keys_;
  nlohmann::json& document_;
  Warnings& warnings_;
  ModelFiles files_;
  std::map<std::string, Found> by_name_;
  std::vector<std::unique_ptr<Found>> unnamed_;
  bool changed_ = false;
};

}  // namespace enfilade
