#include "import/luminaire_files.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <optional>

#include "base/error.hpp"
#include "json/json_text.hpp"
#include "json/model_files.hpp"
#include "photometry/files/photometric_file.hpp"
#include "scene/photopic.hpp"

namespace enfilade {
namespace {

namespace fs = std::filesystem;

/// Letters and digits alone, in lower case; bytes beyond ASCII as they are.
std::string key_of(const std::string& name) {
  std::string key;
  for (const char c : name) {
    const auto u = static_cast<unsigned char>(c);
    if (u >= 0x80 || std::isalnum(u) != 0) key += static_cast<char>(u < 0x80 ? std::tolower(u) : u);
  }
  return key;
}

class Catalogue {
 public:
  Catalogue(const std::string& folder, Warnings& warnings) : folder_(folder), warnings_(warnings) {
    std::error_code code;
    if (!fs::is_directory(folder, code))
      throw InputError(folder, "--luminaires", "is no folder", "name one with .ies or .ldt files");
    std::vector<std::string> paths;
    for (fs::recursive_directory_iterator it(folder, code), end; !code && it != end;
         it.increment(code)) {
      if (is_photometric_file(it->path().string())) paths.push_back(it->path().string());
    }
    std::sort(paths.begin(), paths.end());
    for (const std::string& path : paths)
      by_key_[key_of(fs::path(path).stem().string())].push_back(path);
    files_ = paths.size();
    if (paths.empty()) {
      throw InputError(folder, "--luminaires", "holds no photometric file",
                       "put .ies or .ldt files there that are named after the lamps' types");
    }
  }

  std::size_t files() const { return files_; }

  /// Warns of each faulty file whose name no lamp asked for.
  void try_others() {
    for (const auto& [key, paths] : by_key_) {
      if (read_.contains(key)) continue;
      Warnings unused;
      for (const std::string& path : paths) {
        try {
          read(path, unused);
        } catch (const InputError& error) {
          leave_out(error);
        }
      }
    }
  }

  /// None where no file has the name or a part of it. Throws InputError where all files that have
  /// it are faulty.
  const PhotometricFile* find(const std::string& name) {
    if (const PhotometricFile* whole = of_key(key_of(name))) return whole;
    for (std::size_t at = 0; at < name.size();) {
      const std::size_t end = std::min(name.find(':', at), name.size());
      if (const PhotometricFile* part = of_key(key_of(name.substr(at, end - at)))) return part;
      at = end + 1;
    }
    return nullptr;
  }

 private:
  const PhotometricFile* of_key(const std::string& key) {
    const auto paths = by_key_.find(key);
    if (key.empty() || paths == by_key_.end()) return nullptr;
    const auto known = read_.find(key);
    if (known != read_.end()) return &known->second;
    std::optional<InputError> first;
    for (const std::string& path : paths->second) {
      try {
        Warnings own;
        const PhotometricFile* file = &read_.emplace(key, read(path, own)).first->second;
        for (const Warning& w : own.all()) warnings_.add(w.where, w.what);
        return file;
      } catch (const InputError& error) {
        leave_out(error);
        if (!first) first = error;
      }
    }
    throw InputError(*first);
  }

  void leave_out(const InputError& error) {
    const std::string what = error.what();
    const std::string named = error.file() + ": ";
    warnings_.add(error.file(), "faulty photometric file, left out: " +
                                    (what.starts_with(named) ? what.substr(named.size()) : what));
  }

  static PhotometricFile read(const std::string& path, Warnings& warnings) {
    ModelFiles files(path, false);
    const auto beside = [&](const std::string& name) -> std::optional<std::string> {
      const std::string side = ModelFiles::path_from(path, name);
      if (!files.allowed(side) || !ModelFiles::exists(side)) return std::nullopt;
      return files.read(side, {path, "TILT"});
    };
    return read_photometric_file(files.read_model(), path, warnings, beside);
  }

  std::string folder_;
  Warnings& warnings_;
  std::size_t files_ = 0;
  std::map<std::string, std::vector<std::string>> by_key_;  ///< paths, ascending
  std::map<std::string, PhotometricFile> read_;
};

/// The light of a fixture: as much as it had, or as the file has.
LightSource with_distribution(LightSource light, const PhotometricFile& file, const Scene& scene) {
  light.distribution = file.distribution;
  light.cone.reset();
  light.shape = file.opening;
  // A body that hangs from the place, not around it.
  light.p += 0.5 * file.opening.size.z * light.frame.aim;
  if (!light.intensity.empty()) return light;
  const double tilt =
      std::acos(std::clamp(-light.frame.aim.z, -1.0, 1.0)) * 180.0 / std::numbers::pi;
  const double intensity =
      file.distribution->mean() * file.tilt.factor(tilt) * per_lumen(scene.unit);
  light.intensity.assign(static_cast<std::size_t>(scene.bands), intensity);
  return light;
}

/// The intensity of a fixture that sends out all of its lamp's flux: how much of it the model's own
/// distribution lets out counts no more once a file tells the distribution.
Spectrum whole_intensity(const LightSource& light, const BuildingLuminaire& lamp) {
  if (!light.distribution || lamp.flux_lm <= 0.0) return light.intensity;
  return Spectrum(light.intensity.size(), lamp.flux_lm / (4.0 * std::numbers::pi));
}

/// Nothing is said of a lamp's missing flux once a file tells it.
void take_back(Warnings& warnings, const std::vector<std::string>& lit) {
  Warnings kept;
  for (const Warning& w : warnings.all()) {
    const bool settled = w.what.find("no luminous flux") != std::string::npos &&
                         std::find(lit.begin(), lit.end(), w.where) != lit.end();
    if (!settled) kept.add(w.where, w.what);
  }
  warnings = std::move(kept);
}

}  // namespace

LuminaireMatches match_luminaires(Scene& scene, const std::string& folder, Warnings& warnings) {
  Catalogue catalogue(folder, warnings);
  LuminaireMatches matches;
  matches.files = catalogue.files();
  std::map<std::string, std::size_t> missing;
  std::vector<std::string> lit;
  std::vector<char> taken(scene.lights.size(), 0);
  for (BuildingLuminaire& lamp : scene.building.luminaires) {
    ++matches.lamps;
    const bool has_light = lamp.light >= 0;
    if (has_light) taken[static_cast<std::size_t>(lamp.light)] = 1;
    const PhotometricFile* file = lamp.file.empty() ? nullptr : catalogue.find(lamp.file);
    if (file == nullptr) file = catalogue.find(lamp.type);
    if (file == nullptr) file = catalogue.find(lamp.name);
    if (file == nullptr) {
      ++missing[!lamp.file.empty() ? lamp.file : lamp.type.empty() ? lamp.name : lamp.type];
      continue;
    }
    ++matches.matched;
    LightSource light{lamp.p, {}};
    if (has_light)
      light.intensity = whole_intensity(scene.lights[static_cast<std::size_t>(lamp.light)], lamp);
    const auto frame = glm::length(lamp.aim) > 0.0 && glm::length(lamp.up) > 0.0
                           ? LightFrame::of(lamp.aim, lamp.up)
                           : std::nullopt;
    light.frame = frame ? *frame : LightFrame::of({0.0, 0.0, -1.0});
    light.name = lamp.name;
    light = with_distribution(std::move(light), *file, scene);
    if (has_light) {
      scene.lights[static_cast<std::size_t>(lamp.light)] = std::move(light);
    } else {
      lamp.light = static_cast<int>(scene.lights.size());
      scene.lights.push_back(std::move(light));
      lit.push_back("lamp " + in_quotes(lamp.name));
    }
  }
  for (std::size_t i = 0; i < taken.size(); ++i) {
    LightSource& light = scene.lights[i];
    if (taken[i] != 0 || light.name.empty() || (light.distribution && !light.cone)) continue;
    ++matches.lamps;
    if (const PhotometricFile* file = catalogue.find(light.name)) {
      ++matches.matched;
      light = with_distribution(light, *file, scene);
    } else {
      ++missing[light.name];
    }
  }
  catalogue.try_others();
  take_back(warnings, lit);
  for (const auto& [name, count] : missing) {
    warnings.add("lamp type " + in_quotes(name) + " (" + std::to_string(count) + " of them)",
                 "has no photometric file in " + folder +
                     ": put one there that bears its name, with the ending .ies or .ldt");
  }
  return matches;
}

}  // namespace enfilade
