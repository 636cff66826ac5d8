// The rooms of a building, as the scene file lists them.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "scene_file/key_reader.hpp"

namespace enfilade {

/// Returns the list under "rooms", in metres; none where the document has none. A room has a "bbox"
/// or an "outline" with "z"; an outline is turned counter-clockwise. Throws InputError that names
/// the key. Keys that are not known go to `unknown`.
std::vector<BuildingRoom> read_rooms(const KeyReader& keys, const nlohmann::json& document,
                                     double scale, std::set<std::string>& unknown);

}  // namespace enfilade
