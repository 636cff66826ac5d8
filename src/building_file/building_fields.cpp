// The plain values of a description; files and options share this one list.
#include "building_file/description.hpp"

namespace enfilade {

std::span<const DescriptionField> building_fields() {
  using B = Building;
  static constexpr DescriptionField fields[] = {
      {"floors", "storeys", &B::floors, 1, 10000},
      {"stairs", "stairwells, spread along the corridor", &B::stairs, 0, 1000},
      {"fire_doors", "walls with a door across the corridor", &B::fire_doors, 0, 1000},
      {"bay_width", "length of corridor that a room has, m", &B::bay_width_m, 2.6, 12},
      {"room_depth", "from the corridor's wall to the window, m", &B::room_depth_m, 4.8, 20},
      {"room_height", "from floor to ceiling, m", &B::room_height_m, 2.4, 6},
      {"corridor_width", "from wall to wall, m", &B::corridor_width_m, 1.4, 10},
      {"slab", "thickness of floors and roof, m", &B::slab_m, 0.1, 1},
      {"wall", "thickness of the walls along the corridor, m", &B::wall_m, 0.05, 0.6},
      {"partition", "thickness of the walls between rooms, m", &B::partition_m, 0.05, 0.6},
      {"facade", "thickness of the outer walls, m", &B::facade_m, 0.1, 1},
      {"door_width", "m", &B::door_width_m, 0.7, 1.1},
      {"door_height", "m", &B::door_height_m, 1.9, 2.3},
      {"window_width", "m", &B::window_width_m, 0.3, 2.2},
      {"window_sill", "height of the window's lower edge, m", &B::window_sill_m, 0.2, 1.5},
      {"window_head", "height of the window's upper edge, m", &B::window_head_m, 1.6, 2.35},
      {"entrance", "a door to the outside", &B::entrance, 0, 1},
      {"lamp_exitance", "of lamps, lm/m2", &B::lamp_exitance, 0, 1e7},
      {"colours", "three bands (red, green, blue) instead of a grey one", &B::colours, 0, 1},
      {"furnace",
       "H in lm/m2: closed, every surface sends out (1 - reflectance) H, so that the "
       "irradiance is H everywhere",
       &B::furnace, 0, 1e9},
      {"probes", "a probe at desk height in every room", &B::probes, 0, 1},
      {"rotate", "degrees about the vertical axis", &B::rotate_deg, -360, 360},
      {"seed", "deals the furniture over the rooms", &B::seed, 0, 2147483647},
  };
  return fields;
}

}  // namespace enfilade
