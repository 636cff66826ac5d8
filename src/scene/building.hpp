// What a building's model says about the building beside its surfaces: carried from importers to
// the scene file, where people and other programs read it. The solver has no use for it.
#pragma once

#include <string>
#include <vector>

#include "base/geometry.hpp"

namespace enfilade {

/// A room of the building.
struct BuildingRoom {
  std::string name, long_name, storey;
  Box box;                     ///< metres
  std::vector<Vec2> outline;   ///< of the floor, metres, counter-clockwise; may be empty
  double floor_area_m2 = 0.0;  ///< 0 where it is not known
  double required_lx = 0.0;    ///< illuminance that the model asks for; 0 where it asks for none
};

/// A door, a window or another opening that light may pass.
struct BuildingPortal {
  std::string kind, name;
  Box box;                      ///< metres
  double transmittance = -1.0;  ///< of its glass for light; below 0 where the model tells none
};

/// A lamp with its fixture.
struct BuildingLuminaire {
  std::string name, type;
  Vec3 p{0.0};                                  ///< where its light is taken to come from, metres
  double flux_lm = 0.0;                         ///< 0 where the model tells none
  Vec3 aim{0.0, 0.0, -1.0}, up{0.0, 1.0, 0.0};  ///< of its frame (scene/light.hpp)
  int light = -1;      ///< which of the scene's lights is its own; -1 where none is
  std::string file{};  ///< within an import: the photometric file that the model names, no folder
};

struct BuildingData {
  std::vector<BuildingRoom> rooms;
  std::vector<BuildingPortal> portals;
  std::vector<BuildingLuminaire> luminaires;
};

}  // namespace enfilade
