// Whether a point of the grid lies in the open space of its room.
#pragma once

#include "occluders/occluders.hpp"
#include "report/survey/building_rooms.hpp"

namespace enfilade {

enum class PointPlace {
  open,
  in_furniture,  ///< inside of a thing: nearly all rays end on backs, or most of those upward near
                 ///< by
  without_floor  ///< no floor of the room lies below: a stairwell, an atrium, outside
};

/// Tells by rays where a point of the room's plan lies.
PointPlace place_of(const Occluders& occluders, const SurveyRoom& room, const Vec3& p);

}  // namespace enfilade
