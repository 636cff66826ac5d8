// RUN/surfaces.csv: mean irradiance and radiosity of every surface of the scene file.
#pragma once

#include <string>

#include "report/pictures/solved_scene.hpp"

namespace enfilade {

/// Returns one line per surface, in the scene's order: index, name, object, area_m2 (of what
/// receives light, both sides of a two-sided surface), mean irradiance and mean radiosity per band,
/// area-weighted, in the unit that the header names. A surface that is wholly covered or dropped
/// has area 0 and empty means.
std::string surfaces_csv(const SolvedScene& solved);

}  // namespace enfilade
