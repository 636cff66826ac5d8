// One storey's walls, floors and ceilings: rooms, corridor, stairwells, and the outer faces.
#pragma once

#include <string>

#include "modeler/building_plan.hpp"
#include "modeler/shapes.hpp"

namespace enfilade {

struct ModelStorey {
  int number = 0;    ///< 0 is the ground floor
  double z_m = 0.0;  ///< of its floor
  bool top = false;
};
ModelStorey storey_of(const Building& building, int number);

/// "floor 1/room 12L", "floor 1/corridor 12": how objects' names begin.
std::string room_name(const ModelStorey& storey, const Bay& bay, BaySide side);
std::string corridor_name(const ModelStorey& storey, const Bay& bay);

/// From the room's side through the wall along the corridor.
ModelPassage door_of(const Building& building, const ModelRoom& room, const ModelStorey& storey);
/// From the room's side through the outer wall.
ModelPassage window_of(const Building& building, const ModelRoom& room, const ModelStorey& storey);
/// From the end of a bay through the wall across the corridor.
ModelPassage fire_door_of(const Building& building, const CrossLine& line,
                          const ModelStorey& storey);
/// From the first bay's start to the outside.
ModelPassage entrance_of(const Building& building, const CrossLine& line,
                         const ModelStorey& storey);
bool has_entrance(const Building& building, const ModelStorey& storey);

void add_room(SurfaceSink& sink, const Building& building, const ModelStorey& storey,
              const Bay& bay, BaySide side);
void add_corridor(SurfaceSink& sink, const Building& building, const BuildingPlan& plan,
                  const ModelStorey& storey, const Bay& bay);
/// The walls of a stairwell and of its opening in the slab above; stairs up, where there is more.
void add_stairwell(SurfaceSink& sink, const Building& building, const ModelStorey& storey,
                   const Bay& bay);
void add_stairs(SurfaceSink& sink, const Building& building, const ModelStorey& storey,
                const ModelRoom& well, const std::string& name);
/// Outer walls of one storey, with the underside of the lowest and the roof of the topmost.
void add_outer_faces(SurfaceSink& sink, const Building& building, const BuildingPlan& plan,
                     const ModelStorey& storey, const Bay& bay);

/// How deep the landing at a stairwell's door is; the rest of it is open to the next storey.
constexpr double landing_depth_m = 1.3;
/// Throws InputError where a flight of stairs does not fit into the room's depth.
void check_stairs(const Building& building);

}  // namespace enfilade
