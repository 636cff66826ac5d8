// A bay's stretch of the corridor, and the walls with doors that part it.
#include "modeler/storey.hpp"

namespace enfilade {
namespace {

constexpr Finish corridor_walls{Material::wall, 0}, floor_finish{Material::corridor_floor, 0};

// The door to the room on that side, seen from the corridor.
Hole door_hole(const Building& building, const ModelStorey& storey, const Bay& bay, BaySide side) {
  return door_of(building, plan_room(building, bay, side), storey).far_hole();
}

// The walls at the ends of the bay, where it has some; the passage belongs to the bay behind it.
void add_cross_walls(SurfaceSink& sink, const Building& building, const BuildingPlan& plan,
                     const ModelStorey& storey, const Bay& bay,
                     const std::array<Vec2, 4>& corners) {
  const double low = storey.z_m, high = low + building.room_height_m;
  const auto border = static_cast<std::size_t>(bay.index);
  const std::string name = corridor_name(storey, bay);
  if (plan.has_cross_wall[border]) {
    WallFace wall{corners[0], corners[3], low, high};
    if (border > 0) wall.hole = fire_door_of(building, bay.start, storey).far_hole();
    const ModelPassage entrance = entrance_of(building, bay.start, storey);
    const bool enters = border == 0 && has_entrance(building, storey);
    if (enters) wall.hole = entrance.near_hole();
    sink.begin_object(name + "/back wall");
    add_wall(sink, wall, corridor_walls, "back wall");
    if (enters) {
      sink.begin_object(name + "/entrance");
      add_passage(sink, entrance, {Material::metal}, floor_finish);
    }
  }
  if (!plan.has_cross_wall[border + 1]) return;
  WallFace wall{corners[2], corners[1], low, high};
  const ModelPassage door = fire_door_of(building, bay.end, storey);
  const bool inner = border + 1 < plan.bays.size();
  if (inner) wall.hole = door.near_hole();
  sink.begin_object(name + "/front wall");
  add_wall(sink, wall, corridor_walls, "front wall");
  if (!inner) return;
  sink.begin_object(name + "/fire door");
  add_passage(sink, door, {Material::metal}, floor_finish);
}

}  // namespace

void add_corridor(SurfaceSink& sink, const Building& building, const BuildingPlan& plan,
                  const ModelStorey& storey, const Bay& bay) {
  const double low = storey.z_m, high = low + building.room_height_m;
  const double half = 0.5 * building.corridor_width_m, inset = 0.5 * building.partition_m;
  const auto border = static_cast<std::size_t>(bay.index);
  const double from = plan.has_cross_wall[border] ? inset : 0.0;
  const double to = plan.has_cross_wall[border + 1] ? -inset : 0.0;
  const std::array<Vec2, 4> corners{
      bay.meet(BayEnd::start, from, -half), bay.meet(BayEnd::end, to, -half),
      bay.meet(BayEnd::end, to, half), bay.meet(BayEnd::start, from, half)};
  const std::string name = corridor_name(storey, bay);
  sink.begin_object(name + "/floor");
  add_floor(sink, corners, low, floor_finish, "floor");
  sink.begin_object(name + "/ceiling");
  add_ceiling(sink, corners, high, {Material::ceiling}, "ceiling");
  sink.begin_object(name + "/right wall");
  add_wall(sink,
           {corners[1], corners[0], low, high, door_hole(building, storey, bay, BaySide::right)},
           corridor_walls, "right wall");
  sink.begin_object(name + "/left wall");
  add_wall(sink,
           {corners[3], corners[2], low, high, door_hole(building, storey, bay, BaySide::left)},
           corridor_walls, "left wall");
  add_cross_walls(sink, building, plan, storey, bay, corners);
}

}  // namespace enfilade
