#include "modeler/storey.hpp"

#include <algorithm>

namespace enfilade {
namespace {

constexpr double door_from_corner_m = 0.3;

// A passage of this width around the middle of a border, from `from_m` ahead of it to `to_m`; left
// is to the left of who walks.
ModelPassage across_corridor(const Building& building, const CrossLine& line,
                             const ModelStorey& storey, double from_m, double to_m) {
  const double half = 0.5 * std::min(1.2, building.corridor_width_m - 0.4);
  const double walk = from_m < to_m ? 1.0 : -1.0;
  const Vec2 left = walk * Vec2(-line.ahead.y, line.ahead.x);
  const Vec2 near = line.at + from_m * line.ahead, far = line.at + to_m * line.ahead;
  return {near + half * left, near - half * left, far - half * left,
          far + half * left,  storey.z_m,         storey.z_m + building.door_height_m};
}

}  // namespace

ModelStorey storey_of(const Building& building, int number) {
  return {number, number * building.storey_height_m(), number + 1 == building.floors};
}

std::string room_name(const ModelStorey& storey, const Bay& bay, BaySide side) {
  return "floor " + std::to_string(storey.number) + "/room " + std::to_string(bay.index + 1) +
         (side == BaySide::left ? "L" : "R");
}

std::string corridor_name(const ModelStorey& storey, const Bay& bay) {
  return "floor " + std::to_string(storey.number) + "/corridor " + std::to_string(bay.index + 1);
}

// Seen from the room, the room's x axis points to the left at the door.
ModelPassage door_of(const Building& building, const ModelRoom& room, const ModelStorey& storey) {
  const double x0 = door_from_corner_m, x1 = x0 + building.door_width_m;
  return {room.world(x1, 0.0),
          room.world(x0, 0.0),
          room.world(x0, -building.wall_m),
          room.world(x1, -building.wall_m),
          storey.z_m,
          storey.z_m + building.door_height_m};
}

ModelPassage window_of(const Building& building, const ModelRoom& room, const ModelStorey& storey) {
  const double x0 = 0.5 * (room.width_m - building.window_width_m);
  const double x1 = x0 + building.window_width_m;
  const double inside = room.depth_m, outside = inside + building.facade_m;
  return {room.world(x0, inside),
          room.world(x1, inside),
          room.world(x1, outside),
          room.world(x0, outside),
          storey.z_m + building.window_sill_m,
          storey.z_m + building.window_head_m};
}

ModelPassage fire_door_of(const Building& building, const CrossLine& line,
                          const ModelStorey& storey) {
  const double half = 0.5 * building.partition_m;
  return across_corridor(building, line, storey, -half, half);
}

ModelPassage entrance_of(const Building& building, const CrossLine& line,
                         const ModelStorey& storey) {
  const double inside = 0.5 * building.partition_m;
  return across_corridor(building, line, storey, inside, inside - building.facade_m);
}

bool has_entrance(const Building& building, const ModelStorey& storey) {
  return building.entrance && storey.number == 0 && !building.is_furnace();
}

}  // namespace enfilade
