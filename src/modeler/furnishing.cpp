// Where furniture stands. In a room, seen from the corridor: the door at the left end of the near
// wall with clear floor behind it, cupboards along both side walls, desks at the window.
#include "modeler/furnishing.hpp"

#include <algorithm>
#include <string>

namespace enfilade {
namespace {

constexpr double two_desks_m = 2.95;  // the width of a room that takes two, or a table amid it
constexpr double from_wall_m = 0.05;
constexpr int storage_places = 4;  // three along the right wall, one along the left

ModelRoom room_of(const Building& building, const BuildingPlan& plan, const Space& space) {
  return plan_room(building, plan.bays[static_cast<std::size_t>(space.bay)], space.side);
}

Frame frame_of(const ModelRoom& room, double z) { return {room.origin, room.x, room.y, z}; }

// Along a side wall, y into the room; `along_m` from the corridor to the piece's nearer end.
Frame at_right_wall(const ModelRoom& room, double along_m, double z) {
  const Vec2 x = glm::normalize(room.corners[2] - room.corners[1]);
  return Frame{room.corners[1], x, {-x.y, x.x}, z}.moved(along_m, 0.0, 0.0);
}
Frame at_left_wall(const ModelRoom& room, double along_m, double length_m, double z) {
  const Vec2 x = glm::normalize(room.corners[0] - room.corners[3]);
  return Frame{room.corners[0], x, {-x.y, x.x}, z}.moved(-along_m - length_m, 0.0, 0.0);
}

int desks_in(const ModelRoom& room) { return room.width_m >= two_desks_m ? 2 : 1; }

Frame desk_at(const ModelRoom& room, int i, double z) {
  const double x = i == 0 ? 0.12 : room.width_m - 0.12 - footprint_m(FurnitureKind::desk).x;
  return frame_of(room, z).moved(x, room.depth_m - 0.85, 0.0);
}

// At the desks, then one for a visitor at the left wall.
Frame chair_at(const ModelRoom& room, int i, double z) {
  const Vec2 size = footprint_m(FurnitureKind::chair);
  if (i < desks_in(room)) {
    const double middle = 0.5 * (footprint_m(FurnitureKind::desk).x - size.x);
    return desk_at(room, i, z).moved(middle, -0.65, 0.0);
  }
  Frame frame = frame_of(room, z).moved(0.12, 2.36 + size.x, 0.0);
  frame.x = -room.y;
  frame.y = room.x;
  return frame;
}

Frame storage_at(const ModelRoom& room, int place, double z) {
  const double length = footprint_m(FurnitureKind::shelf).x;
  const Frame wall = place < storage_places - 1 ? at_right_wall(room, 0.2 + 0.86 * place, z)
                                                : at_left_wall(room, 1.5, length, z);
  return wall.moved(0.0, from_wall_m, 0.0);
}

Frame picture_at(const ModelRoom& room, int i, double z) {
  if (i % 2 == 0) return at_right_wall(room, 0.5 + 0.55 * i, z);
  return at_left_wall(room, 1.6 + 0.5 * (i - 1), footprint_m(FurnitureKind::picture).x, z);
}

// In a row through the room's middle, or in two.
Frame lamp_at(const ModelRoom& room, int i, int count, double ceiling) {
  const Vec2 size = footprint_m(FurnitureKind::lamp);
  const Frame frame = frame_of(room, ceiling);
  const int rows = count <= 3 ? count : (count + 1) / 2;
  const double y = room.depth_m * (i % rows + 0.5) / rows;
  if (count <= 3) return frame.moved(0.5 * (room.width_m - size.x), y - 0.5 * size.y, 0.0);
  const double x = room.width_m * (i / rows == 0 ? 0.25 : 0.75);
  Frame turned = frame.moved(x + 0.5 * size.y, y - 0.5 * size.x, 0.0);
  turned.x = room.y;
  turned.y = -room.x;
  return turned;
}

// In a row along the corridor's middle.
Frame corridor_lamp_at(const Building& building, const Bay& bay, int i, int count, double ceiling) {
  const Vec2 size = footprint_m(FurnitureKind::lamp);
  const double x = building.bay_width_m * (i + 0.5) / count;
  return Frame{bay.start.at, bay.ahead, bay.left, ceiling}.moved(x - 0.5 * size.x, -0.5 * size.y,
                                                                 0.0);
}

}  // namespace

int places_for(const Building& building, const BuildingPlan& plan, const Space& space,
               FurnitureKind kind) {
  if (space.kind == Space::Kind::stairs) return kind == FurnitureKind::lamp ? 1 : 0;
  if (space.kind == Space::Kind::corridor) return kind == FurnitureKind::lamp ? 2 : 0;
  const auto has = [&](FurnitureKind other) { return space.has[index_of(other)]; };
  const auto room = [&] { return room_of(building, plan, space); };
  switch (kind) {
    case FurnitureKind::lamp:
      return 6;
    case FurnitureKind::desk:
      return desks_in(room());
    case FurnitureKind::chair:
      return desks_in(room()) + 1;
    case FurnitureKind::table:
      return room().width_m >= two_desks_m ? 1 : 0;
    case FurnitureKind::shelf:
      return storage_places;
    case FurnitureKind::cupboard:
      return storage_places - has(FurnitureKind::shelf);
    case FurnitureKind::bin:
    case FurnitureKind::plant:
      return 1;
    case FurnitureKind::monitor:
    case FurnitureKind::desk_lamp:
      return has(FurnitureKind::desk);
    case FurnitureKind::picture:
      return 5;
  }
  return 0;
}

Frame place_of(const Building& building, const BuildingPlan& plan, const ModelStorey& storey,
               const Space& space, FurnitureKind kind, int i) {
  const double floor = storey.z_m, ceiling = floor + building.room_height_m;
  const int lamps = space.has[index_of(FurnitureKind::lamp)];
  if (space.kind == Space::Kind::corridor) {
    const Bay& bay = plan.bays[static_cast<std::size_t>(space.bay)];
    return corridor_lamp_at(building, bay, i, lamps, ceiling);
  }
  ModelRoom room = room_of(building, plan, space);
  if (space.kind == Space::Kind::stairs) room.depth_m = landing_depth_m;
  switch (kind) {
    case FurnitureKind::lamp:
      return lamp_at(room, i, lamps, ceiling);
    case FurnitureKind::desk:
      return desk_at(room, i, floor);
    case FurnitureKind::chair:
      return chair_at(room, i, floor);
    case FurnitureKind::table:
      return frame_of(room, floor).moved(1.0, 2.05, 0.0);
    case FurnitureKind::shelf:
      return storage_at(room, i, floor);
    case FurnitureKind::cupboard:
      return storage_at(room, storage_places - 1 - i, floor);
    case FurnitureKind::bin:
      return frame_of(room, floor).moved(0.26, room.depth_m - 1.75, 0.0);
    case FurnitureKind::plant:
      return frame_of(room, floor).moved(room.width_m - 0.3, room.depth_m - 1.8, 0.0);
    case FurnitureKind::monitor:
      return desk_at(room, i, floor).moved(0.4, 0.45, desk_height_m);
    case FurnitureKind::desk_lamp:
      return desk_at(room, i, floor).moved(0.1, 0.45, desk_height_m);
    case FurnitureKind::picture:
      return picture_at(room, i, floor);
  }
  return {};
}

std::string space_name(const BuildingPlan& plan, const ModelStorey& storey, const Space& space) {
  const Bay& bay = plan.bays[static_cast<std::size_t>(space.bay)];
  return space.kind == Space::Kind::corridor ? corridor_name(storey, bay)
                                             : room_name(storey, bay, space.side);
}

void furnish(SurfaceSink& sink, const Building& building, const BuildingPlan& plan,
             const ModelStorey& storey, const Space& space) {
  const std::string name = space_name(plan, storey, space);
  for (std::size_t k = 0; k < furniture_kinds; ++k) {
    const auto kind = static_cast<FurnitureKind>(k);
    for (int i = 0; i < space.has[k]; ++i) {
      sink.begin_object(name + "/" + name_of(kind) + " " + std::to_string(i + 1));
      const auto variant = static_cast<unsigned>(7 * space.bay + 3 * storey.number + i);
      add_furniture(sink, kind, place_of(building, plan, storey, space, kind, i), variant);
    }
  }
}

}  // namespace enfilade
