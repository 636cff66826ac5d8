// A room: floor, ceiling, four walls, the door to the corridor and the window.
#include "modeler/storey.hpp"

namespace enfilade {
namespace {

void add_window(SurfaceSink& sink, const Building& building, const ModelPassage& window,
                const std::string& name) {
  sink.begin_object(name + "/window");
  add_passage(sink, window, {Material::ceiling}, {Material::ceiling});
  if (building.windows != Windows::closed) return;
  add_wall(sink, {window.e, window.c, window.low_m, window.high_m}, {Material::glass}, "pane");
}

}  // namespace

void add_room(SurfaceSink& sink, const Building& building, const ModelStorey& storey,
              const Bay& bay, BaySide side) {
  const ModelRoom room = plan_room(building, bay, side);
  const std::string name = room_name(storey, bay, side);
  const auto& corners = room.corners;
  const double low = storey.z_m, high = low + building.room_height_m;
  const unsigned paint =
      static_cast<unsigned>(3 * bay.index + (side == BaySide::left ? 0 : 1) + 2 * storey.number);
  const Finish walls{Material::wall, paint}, floor{Material::floor, paint};
  const ModelPassage door = door_of(building, room, storey);

  sink.begin_object(name + "/floor");
  add_floor(sink, corners, low, floor, "floor");
  sink.begin_object(name + "/ceiling");
  add_ceiling(sink, corners, high, {Material::ceiling}, "ceiling");
  sink.begin_object(name + "/door wall");
  add_wall(sink, {corners[1], corners[0], low, high, door.near_hole()}, walls, "door wall");
  sink.begin_object(name + "/right wall");
  add_wall(sink, {corners[2], corners[1], low, high}, walls, "right wall");
  sink.begin_object(name + "/left wall");
  add_wall(sink, {corners[0], corners[3], low, high}, walls, "left wall");

  WallFace outer{corners[3], corners[2], low, high};
  const ModelPassage window = window_of(building, room, storey);
  if (building.windows != Windows::none) outer.hole = window.near_hole();
  sink.begin_object(name + "/window wall");
  add_wall(sink, outer, walls, "window wall");
  sink.begin_object(name + "/door");
  add_passage(sink, door, {Material::wood}, floor);
  if (building.windows != Windows::none) add_window(sink, building, window, name);
}

}  // namespace enfilade
