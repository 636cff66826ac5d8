// Stairwells: a tall room with a landing on every storey, and two flights of steps between them.
#include <cmath>

#include "base/error.hpp"
#include "modeler/storey.hpp"

namespace enfilade {
namespace {

constexpr double tread_depth_m = 0.27;
constexpr double highest_riser_m = 0.18;
constexpr double clearance_m = 0.02;  // stairs touch nothing: what touches would hide a strip of it
constexpr double between_flights_m = 0.1;
constexpr double least_landing_m = 0.9;
constexpr Finish stair_concrete{Material::concrete, 0}, stair_walls{Material::wall, 0};

struct Steps {
  int treads;  ///< of one flight; its last riser is the landing's edge
  double riser_m;
  double length_m() const { return treads * tread_depth_m; }
};

Steps steps_of(const Building& building) {
  const double half = 0.5 * building.storey_height_m();
  const int risers = static_cast<int>(std::ceil(half / highest_riser_m - 1e-9));
  return {risers - 1, half / risers};
}

// Where the flights end and the landing half-way up begins.
double turn_at_m(const Steps& steps) {
  return landing_depth_m + 2.0 * clearance_m + steps.length_m();
}

// One step's part of a flight: along y from `y0` to `y1`, its underside from `low0` to `low1`.
void add_step(SurfaceSink& sink, const Frame& f, double width, double y0, double y1, double low0,
              double low1, double riser_low, double top) {
  sink.add({f.at(0, y0, top), f.at(width, y0, top), f.at(width, y1, top), f.at(0, y1, top)},
           stair_concrete, "tread");
  sink.add(
      {f.at(0, y0, riser_low), f.at(width, y0, riser_low), f.at(width, y0, top), f.at(0, y0, top)},
      stair_concrete, "riser");
  sink.add({f.at(0, y1, low1), f.at(0, y0, low0), f.at(0, y0, top), f.at(0, y1, top)},
           stair_concrete, "string");
  sink.add(
      {f.at(width, y0, low0), f.at(width, y1, low1), f.at(width, y1, top), f.at(width, y0, top)},
      stair_concrete, "string");
}

// A solid flight that climbs along the frame's y; flat below its first step, then sloping.
void add_flight(SurfaceSink& sink, const Frame& f, double width, const Steps& steps) {
  const double g = tread_depth_m, r = steps.riser_m, foot = clearance_m;
  const double end = steps.length_m(), end_low = foot + (steps.treads - 1) * r;
  for (int i = 0; i < steps.treads; ++i) {
    const double low0 = i == 0 ? foot : foot + (i - 1) * r, low1 = foot + i * r;
    add_step(sink, f, width, i * g, (i + 1) * g, low0, i == 0 ? foot : low1, i == 0 ? foot : i * r,
             (i + 1) * r);
  }
  sink.add({f.at(0, 0, foot), f.at(0, g, foot), f.at(width, g, foot), f.at(width, 0, foot)},
           stair_concrete, "underside");
  sink.add(
      {f.at(0, g, foot), f.at(0, end, end_low), f.at(width, end, end_low), f.at(width, g, foot)},
      stair_concrete, "underside");
  sink.add({f.at(width, end, end_low), f.at(0, end, end_low), f.at(0, end, steps.treads * r),
            f.at(width, end, steps.treads * r)},
           stair_concrete, "head");
}

// The slab's thickness around the opening above.
void add_opening(SurfaceSink& sink, const std::array<Vec2, 4>& well, double low, double high) {
  for (std::size_t i = 0; i < 4; ++i) {
    add_wall(sink, {well[(i + 1) % 4], well[i], low, high}, i == 0 ? stair_concrete : stair_walls,
             "slab edge");
  }
}

}  // namespace

void check_stairs(const Building& building) {
  if (building.floors < 2 || building.stairs == 0) return;
  const double needed = turn_at_m(steps_of(building)) + least_landing_m;
  if (building.room_depth_m >= needed) return;
  throw building.fault(
      "room_depth",
      "leaves no room for stairs of " + std::to_string(building.storey_height_m()) + " m a storey",
      "make rooms " + std::to_string(needed) + " m deep, or lower");
}

void add_stairs(SurfaceSink& sink, const Building& building, const ModelStorey& storey,
                const ModelRoom& well, const std::string& name) {
  const Steps steps = steps_of(building);
  const double width = 0.5 * (well.width_m - between_flights_m) - clearance_m;
  const double first = landing_depth_m + clearance_m, turn = turn_at_m(steps);
  const Frame room{well.origin, well.x, well.y, storey.z_m};
  if (storey.top) {
    sink.begin_object(name + "/guard");
    add_box(sink, room, {clearance_m, first - 0.1, 0.05}, {clearance_m + width, first - 0.05, 1.0},
            {Material::metal}, "guard");
    return;
  }
  const double half_way = (steps.treads + 1) * steps.riser_m;
  sink.begin_object(name + "/lower flight");
  add_flight(sink, room.moved(clearance_m, first, 0.0), width, steps);
  sink.begin_object(name + "/half-way landing");
  add_box(sink, room, {clearance_m, turn, half_way - 0.15},
          {well.width_m - clearance_m, well.depth_m - clearance_m, half_way}, stair_concrete,
          "landing");
  sink.begin_object(name + "/upper flight");
  Frame back = room.moved(well.width_m - clearance_m, first + steps.length_m(), half_way);
  back.x = -back.x;
  back.y = -back.y;
  add_flight(sink, back, width, steps);
}

void add_stairwell(SurfaceSink& sink, const Building& building, const ModelStorey& storey,
                   const Bay& bay) {
  const ModelRoom room = plan_room(building, bay, BaySide::left);
  const std::string name = room_name(storey, bay, BaySide::left) + "/stairs";
  const auto& c = room.corners;
  const double low = storey.z_m, high = low + building.room_height_m;
  const double share = landing_depth_m / room.depth_m;
  const Vec2 edge0 = glm::mix(c[0], c[3], share), edge1 = glm::mix(c[1], c[2], share);
  const std::array<Vec2, 4> landing{c[0], c[1], edge1, edge0};
  const ModelPassage door = door_of(building, room, storey);

  sink.begin_object(name + "/floor");
  add_floor(sink, storey.number == 0 ? c : landing, low, stair_concrete, "floor");
  sink.begin_object(name + "/ceiling");
  add_ceiling(sink, storey.top ? c : landing, high, {Material::ceiling}, "ceiling");
  sink.begin_object(name + "/walls");
  add_wall(sink, {c[1], c[0], low, high, door.near_hole()}, stair_walls, "wall");
  for (std::size_t i = 1; i < 4; ++i) {
    add_wall(sink, {c[(i + 1) % 4], c[i], low, high}, stair_walls, "wall");
  }
  if (!storey.top) {
    add_opening(sink, {edge0, edge1, c[2], c[3]}, high, low + building.storey_height_m());
  }
  sink.begin_object(name + "/door");
  add_passage(sink, door, {Material::wood}, stair_concrete);
  add_stairs(sink, building, storey, room, name);
}

}  // namespace enfilade
