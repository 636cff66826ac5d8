// The lights of a scene file: "lights", "luminaires", and surfaces with a distribution.
#pragma once

#include <functional>

#include "scene_file/distribution_source.hpp"

namespace enfilade {

/// Reads into a scene whose unit is known.
class LightReader {
 public:
  /// Told of each spectrum that is read: how many bands the scene has.
  using NoteBands = std::function<void(const Spectrum&, const std::string& where)>;
  LightReader(const KeyReader& keys, DistributionSource& distributions, double metres_per_unit,
              NoteBands note_bands, std::set<std::string>& unknown, Warnings& warnings)
      : keys_(keys),
        distributions_(distributions),
        scale_(metres_per_unit),
        note_bands_(std::move(note_bands)),
        unknown_(unknown),
        warnings_(warnings) {}

  void read_lights(const nlohmann::json& document, Scene& scene);
  /// An entry gives light where it has a distribution, a file or a flux; others describe fixtures
  /// whose light stands elsewhere.
  void read_luminaires(nlohmann::json& document, Scene& scene);
  /// The distribution of a surface's light, and the exitance by the distribution's flux where the
  /// surface has none.
  void read_distribution(nlohmann::json& entry, const std::string& where, ExitanceUnit unit,
                         Surface& surface);

 private:
  LightSource read_light(const nlohmann::json& entry, const std::string& where);
  void read_luminaire(nlohmann::json& entry, const std::string& where, Scene& scene);
  Spectrum light_of(const nlohmann::json& entry, const char* key, const std::string& where);
  LightFrame frame_of(const nlohmann::json& entry, const std::string& where);
  LuminousOpening opening_of(const nlohmann::json& size, const std::string& where);
  void note_unknown(const nlohmann::json& entry, const char* list,
                    std::initializer_list<std::string_view> known);

  const KeyReader& keys_;
  DistributionSource& distributions_;
  double scale_;
  NoteBands note_bands_;
  std::set<std::string>& unknown_;
  Warnings& warnings_;
};

}  // namespace enfilade
