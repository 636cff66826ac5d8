// The heights of a room's floor and ceiling, by rays.
#pragma once

#include <optional>

#include "occluders/occluders.hpp"
#include "report/survey/room_plan.hpp"

namespace enfilade {

struct FloorHeight {
  std::optional<double> floor_m, ceiling_m;  ///< none where rays find none
};

/// Looks down and up from points of the room at height `from_m`. The floor is the lowest level on
/// which a quarter of the rays end (to within 3 cm, or 1% of the room's height), or the one on
/// which most do, so that tables do not count; the ceiling is the median of what is seen above.
/// Backs count as well: a surface that faces the wrong way is still a floor.
FloorHeight floor_height(const Occluders& occluders, const RoomPlan& plan, double from_m);

}  // namespace enfilade
