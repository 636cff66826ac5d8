// The "sky" of a scene file.
#pragma once

#include <functional>

#include "scene_file/key_reader.hpp"

namespace enfilade {

/// Reads {"type": "overcast" | "clear" | "uniform" | 1 .. 15, "zenith" or "horizontal_illuminance",
/// "sun": {"elevation", "azimuth", "illuminance"}, "north", "up", "ground_reflectance"}. Angles in
/// degrees, the azimuth clockwise from north as seen from above. `note_bands` is told of each
/// spectrum. Throws InputError that names the key.
Sky read_sky(const KeyReader& keys, const nlohmann::json& value,
             const std::function<void(const Spectrum&, const std::string& where)>& note_bands,
             std::set<std::string>& unknown);

}  // namespace enfilade
