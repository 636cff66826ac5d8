// The description of a building, from which all of its surfaces follow (§4.2: the paper's modeler).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/error.hpp"

namespace enfilade {

/// A row of bays along the corridor; a bay has a room on either side. A wing that turns follows an
/// arc, cut into one chord a bay, so that its rooms are trapezia and its walls stand at all angles.
struct Wing {
  int bays = 8;
  double turn_deg = 0.0;  ///< over the whole wing, to the left
};

enum class FurnitureKind {
  lamp,
  desk,
  chair,
  table,
  shelf,
  cupboard,
  bin,
  plant,
  monitor,
  desk_lamp,
  picture
};
constexpr std::size_t furniture_kinds = 11;
const char* name_of(FurnitureKind kind);
constexpr std::size_t index_of(FurnitureKind kind) { return static_cast<std::size_t>(kind); }

/// How many of each kind.
using FurnitureCounts = std::array<int, furniture_kinds>;

enum class Windows { open, closed, none };

/// Lengths in metres. The corridor's centre line starts at the origin along +x; z = 0 is the ground
/// floor.
struct Building {
  std::string file = "building";         ///< where it was described, for messages
  std::vector<std::string> option_keys;  ///< keys whose values the command line sets
  int floors = 2;
  std::vector<Wing> wings{Wing{}};
  int stairs = 1;      ///< stairwells, spread along the corridor, each in place of one left room
  int fire_doors = 0;  ///< walls with a door across the corridor, spread along it
  double bay_width_m = 3.6;
  double room_depth_m = 5.0;
  double room_height_m = 2.8;
  double corridor_width_m = 2.2;
  double slab_m = 0.3;        ///< thickness of floors and of the roof
  double wall_m = 0.15;       ///< thickness of the walls along the corridor
  double partition_m = 0.12;  ///< thickness of the walls between rooms
  double facade_m = 0.35;     ///< thickness of the outer walls
  double door_width_m = 0.9;
  double door_height_m = 2.1;
  double window_width_m = 1.6;
  double window_sill_m = 0.9;
  double window_head_m = 2.3;
  Windows windows = Windows::open;
  bool entrance = true;                ///< a door to the outside at the corridor's start
  FurnitureCounts furniture{};         ///< on every storey
  FurnitureCounts ground_furniture{};  ///< on the ground floor beside those
  double lamp_exitance = 9000.0;       ///< lm/m2
  bool colours = false;                ///< three bands (red, green, blue) instead of a grey one
  double furnace = 0.0;     ///< H > 0, lm/m2: closed, each surface sends out (1 - reflectance) H
  bool probes = false;      ///< a probe at desk height in every room
  double rotate_deg = 0.0;  ///< about the vertical axis through the origin
  int seed = 1;             ///< deals the furniture over the rooms

  bool is_furnace() const { return furnace > 0.0; }
  double storey_height_m() const { return room_height_m + slab_m; }
  int bays() const;
  /// Returns an error about the value of a key, by its path (wings[2].turn): it names the file, or
  /// the option of the command line that set the value.
  InputError fault(const std::string& key, const std::string& what, const std::string& hint) const;
};

}  // namespace enfilade
