// The outer faces of the building.
#include "modeler/storey.hpp"

namespace enfilade {
namespace {

constexpr Finish outer_facade{Material::facade, 0}, outer_concrete{Material::concrete, 0};

// How far ahead of a border the building reaches: half a partition short of nothing inside, the
// outer wall at either end.
double reach(const Building& building, const BuildingPlan& plan, const Bay& bay, BayEnd end) {
  const double beyond = building.facade_m - 0.5 * building.partition_m;
  if (end == BayEnd::start) return bay.index == 0 ? -beyond : 0.0;
  return bay.index + 1 == static_cast<int>(plan.bays.size()) ? beyond : 0.0;
}

void add_side(SurfaceSink& sink, const Building& building, const BuildingPlan& plan,
              const ModelStorey& storey, const Bay& bay, BaySide side, WallFace wall) {
  const double sign = side == BaySide::left ? 1.0 : -1.0;
  const BayEnd left = side == BaySide::left ? BayEnd::end : BayEnd::start;
  const BayEnd right = side == BaySide::left ? BayEnd::start : BayEnd::end;
  wall.left = bay.meet(left, reach(building, plan, bay, left), sign * plan.half_depth_m);
  wall.right = bay.meet(right, reach(building, plan, bay, right), sign * plan.half_depth_m);
  const bool is_well = side == BaySide::left && bay.stairs;
  const ModelPassage window = window_of(building, plan_room(building, bay, side), storey);
  if (building.windows != Windows::none && !is_well) wall.hole = window.far_hole();
  sink.begin_object(room_name(storey, bay, side) + "/facade");
  add_wall(sink, wall, outer_facade, "facade");
  if (building.windows != Windows::closed || is_well) return;
  add_wall(sink, {window.c, window.e, window.low_m, window.high_m}, {Material::glass}, "pane");
}

void add_end(SurfaceSink& sink, const Building& building, const BuildingPlan& plan,
             const ModelStorey& storey, const Bay& bay, BayEnd end, WallFace wall) {
  const double sign = end == BayEnd::start ? 1.0 : -1.0;
  const double ahead = reach(building, plan, bay, end);
  wall.left = bay.meet(end, ahead, sign * plan.half_depth_m);
  wall.right = bay.meet(end, ahead, -sign * plan.half_depth_m);
  if (end == BayEnd::start && has_entrance(building, storey)) {
    wall.hole = entrance_of(building, bay.start, storey).far_hole();
  }
  sink.begin_object(corridor_name(storey, bay) + "/facade");
  add_wall(sink, wall, outer_facade, "facade");
}

}  // namespace

void add_outer_faces(SurfaceSink& sink, const Building& building, const BuildingPlan& plan,
                     const ModelStorey& storey, const Bay& bay) {
  WallFace wall;
  wall.low_m = storey.number == 0 ? -building.slab_m : storey.z_m;
  wall.high_m = storey.z_m + building.storey_height_m();
  add_side(sink, building, plan, storey, bay, BaySide::left, wall);
  add_side(sink, building, plan, storey, bay, BaySide::right, wall);
  const bool first = bay.index == 0, last = bay.index + 1 == static_cast<int>(plan.bays.size());
  if (first) add_end(sink, building, plan, storey, bay, BayEnd::start, wall);
  if (last) add_end(sink, building, plan, storey, bay, BayEnd::end, wall);

  const double start = reach(building, plan, bay, BayEnd::start);
  const double end = reach(building, plan, bay, BayEnd::end), half = plan.half_depth_m;
  const std::array<Vec2, 4> corners{
      bay.meet(BayEnd::start, start, -half), bay.meet(BayEnd::end, end, -half),
      bay.meet(BayEnd::end, end, half), bay.meet(BayEnd::start, start, half)};
  sink.begin_object(corridor_name(storey, bay) + "/envelope");
  if (storey.number == 0) add_ceiling(sink, corners, wall.low_m, outer_concrete, "underside");
  if (storey.top) add_floor(sink, corners, wall.high_m, outer_concrete, "roof");
}

}  // namespace enfilade
