// The rooms of a building whose light is surveyed: those that the scene file names, else the cells.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "report/plans/planned_building.hpp"
#include "report/survey/room_plan.hpp"
#include "scene/building.hpp"

namespace enfilade {

/// Where a room's light is surveyed.
struct SurveyRoom {
  std::string name, long_name, storey;
  RoomPlan plan;
  double area_m2 = 0.0;                   ///< as the file tells it, else that of the plan
  double floor_m = 0.0, ceiling_m = 0.0;  ///< heights, as rays find them, else those of the box
  bool has_floor = false, has_ceiling = false;  ///< found by rays
  double required = 0.0;                        ///< illuminance, lx; 0 where none is asked for
  double height_m() const { return ceiling_m - floor_m; }
};

/// Returns a room for each of `told`, or for each cell that is a room with a floor where nothing is
/// told. Where a room is told by its box alone, its plan is what the cells say: the part within the
/// box of the cells that belong to the room, so that a room need not be a rectangle. A cell belongs
/// to a room where half of the room's floor lies in it, or where it lies in the room's box by half
/// and in no other room's box so well.
std::vector<SurveyRoom> rooms_of_building(const PlannedBuilding& building,
                                          std::span<const BuildingRoom> told);

}  // namespace enfilade
