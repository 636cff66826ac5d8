// The storeys of a building, found from its floors.
#pragma once

#include <vector>

#include "report/plans/planned_building.hpp"

namespace enfilade {

struct Storey {
  double floor_m = 0.0;     ///< height of the floor
  double headroom_m = 0.0;  ///< from there to the ceiling, median over the floor's area
};

/// Returns at least one storey, lowest first: the heights where much upward area with headroom
/// lies.
std::vector<Storey> storeys(const PlannedBuilding& building);

/// Returns the box around the surfaces that face rooms; around all surfaces where no cell is a
/// room.
Box room_bounds(const PlannedBuilding& building);

}  // namespace enfilade
