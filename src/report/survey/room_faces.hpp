// Mean light on a room's walls and on its ceiling, read off the patches.
#pragma once

#include <optional>

#include "report/pictures/solved_scene.hpp"
#include "report/survey/building_rooms.hpp"

namespace enfilade {

/// Light per area, in the scene's unit, as one value (one_value.hpp); none where rays find no
/// such surface.
struct FaceLight {
  std::optional<double> walls, ceiling;
};

/// Walls: upright surfaces at the edge of the room's plan, from floor to ceiling; furniture that
/// stands in front of one hides it. Ceiling: what faces down above the floor, lamps set into it
/// included. Both are sampled evenly over their area.
FaceLight face_light(const SolvedScene& solved, const SurveyRoom& room);

}  // namespace enfilade
