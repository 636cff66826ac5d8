#include "modeler/building_plan.hpp"

#include <cmath>
#include <numbers>

#include "base/error.hpp"

namespace enfilade {
namespace {

constexpr double least_room_width_m = 2.4;  // for a door, and furniture on both sides

std::string wing_key(int wing) { return "wings[" + std::to_string(wing) + "]"; }

// The directions of all chords. Within an arc the path turns by the same angle from bay to bay, and
// by half of that where the arc begins and ends: its chords are those of one circle.
std::vector<double> chord_directions(const Building& building) {
  std::vector<double> directions;
  double heading = 0.0;
  for (const Wing& wing : building.wings) {
    const double step = wing.turn_deg * std::numbers::pi / 180.0 / wing.bays;
    for (int i = 0; i < wing.bays; ++i) directions.push_back(heading + (i + 0.5) * step);
    heading += wing.turn_deg * std::numbers::pi / 180.0;
  }
  return directions;
}

Vec2 direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

std::vector<Bay> lay_bays(const Building& building) {
  const std::vector<double> angles = chord_directions(building);
  std::vector<Bay> bays;
  Vec2 at(0.0);
  int wing = 0, left_in_wing = building.wings[0].bays;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    if (left_in_wing == 0) left_in_wing = building.wings[static_cast<std::size_t>(++wing)].bays;
    --left_in_wing;
    const double before = i == 0 ? angles[i] : angles[i - 1];
    const double after = i + 1 == angles.size() ? angles[i] : angles[i + 1];
    Bay bay;
    bay.index = static_cast<int>(i);
    bay.wing = wing;
    bay.ahead = direction(angles[i]);
    bay.left = {-bay.ahead.y, bay.ahead.x};
    bay.start = {at, direction(0.5 * (before + angles[i]))};
    at += building.bay_width_m * bay.ahead;
    bay.end = {at, direction(0.5 * (angles[i] + after))};
    bays.push_back(bay);
  }
  return bays;
}

// Spread evenly: the i-th of n lies in the middle of the i-th of n equal parts.
void place_stairs(const Building& building, std::vector<Bay>& bays) {
  if (building.floors < 2) return;
  for (int i = 0; i < building.stairs; ++i) {
    const auto at = (2 * static_cast<std::size_t>(i) + 1) * bays.size() /
                    (2 * static_cast<std::size_t>(building.stairs));
    bays[at].stairs = true;
  }
}

std::vector<char> place_cross_walls(const Building& building) {
  const auto borders = static_cast<std::size_t>(building.bays()) + 1;
  std::vector<char> has(borders, 0);
  has.front() = has.back() = 1;
  for (int i = 1; i <= building.fire_doors; ++i) {
    has[static_cast<std::size_t>(i) * (borders - 1) /
        (static_cast<std::size_t>(building.fire_doors) + 1)] = 1;
  }
  return has;
}

void check_bends(const Building& building, const BuildingPlan& plan) {
  for (const Bay& bay : plan.bays) {
    for (const BaySide side : {BaySide::left, BaySide::right}) {
      const double width = plan_room(building, bay, side).width_m;
      if (width >= least_room_width_m) continue;
      throw building.fault(
          wing_key(bay.wing), "leaves its inner rooms " + std::to_string(width) + " m of width",
          "let it turn less, or give it more bays or wider ones (rooms need 2.4 m)");
    }
  }
}

std::array<Vec2, 4> outline(const Bay& bay, double half) {
  return {bay.meet(BayEnd::start, 0, -half), bay.meet(BayEnd::end, 0, -half),
          bay.meet(BayEnd::end, 0, half), bay.meet(BayEnd::start, 0, half)};
}

// Is there an edge of a that all of b lies beyond?
bool parted_by_edge(const std::array<Vec2, 4>& a, const std::array<Vec2, 4>& b) {
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec2 edge = a[(i + 1) % 4] - a[i];
    bool beyond = true;
    for (const Vec2& p : b) beyond &= edge.x * (p.y - a[i].y) - edge.y * (p.x - a[i].x) <= 0.0;
    if (beyond) return true;
  }
  return false;
}

void check_crossings(const Building& building, const BuildingPlan& plan) {
  const double reach = 2.0 * plan.half_depth_m + 2.0 * building.bay_width_m;
  for (std::size_t i = 0; i < plan.bays.size(); ++i) {
    for (std::size_t j = i + 2; j < plan.bays.size(); ++j) {
      const Bay &a = plan.bays[i], &b = plan.bays[j];
      if (glm::length(a.start.at - b.start.at) > reach) continue;
      const auto p = outline(a, plan.half_depth_m), q = outline(b, plan.half_depth_m);
      if (parted_by_edge(p, q) || parted_by_edge(q, p)) continue;
      throw building.fault(wing_key(b.wing), "runs into " + wing_key(a.wing),
                           "let it turn less, or put a longer wing between them");
    }
  }
}

}  // namespace

Vec2 Bay::meet(BayEnd at, double ahead_m, double to_left_m) const {
  const CrossLine& line = at == BayEnd::start ? start : end;
  const Vec2 p = line.at + to_left_m * left;
  // p lies on the chord's parallel, as line.at lies on the chord.
  const double beyond = ahead_m - glm::dot(p - line.at, line.ahead);
  return p + beyond / glm::dot(ahead, line.ahead) * ahead;
}

ModelRoom plan_room(const Building& building, const Bay& bay, BaySide side) {
  const double sign = side == BaySide::left ? 1.0 : -1.0;
  const double near_m = sign * (0.5 * building.corridor_width_m + building.wall_m);
  const double far_m = near_m + sign * building.room_depth_m;
  const double inset = 0.5 * building.partition_m;
  const auto start = [&](double v) { return bay.meet(BayEnd::start, inset, v); };
  const auto end = [&](double v) { return bay.meet(BayEnd::end, -inset, v); };
  ModelRoom room;
  if (side == BaySide::left) {
    room.corners = {start(near_m), end(near_m), end(far_m), start(far_m)};
  } else {
    room.corners = {end(near_m), start(near_m), start(far_m), end(far_m)};
  }
  room.x = sign * bay.ahead;
  room.y = sign * bay.left;
  room.depth_m = building.room_depth_m;
  const Vec2 base = room.corners[0];
  const auto along = [&](std::size_t i) { return glm::dot(room.corners[i] - base, room.x); };
  const double low = std::max(0.0, along(3)), high = std::min(along(1), along(2));
  room.origin = base + low * room.x;
  room.width_m = high - low;
  return room;
}

BuildingPlan plan_building(const Building& building) {
  BuildingPlan plan;
  plan.half_depth_m =
      0.5 * building.corridor_width_m + building.wall_m + building.room_depth_m + building.facade_m;
  plan.bays = lay_bays(building);
  place_stairs(building, plan.bays);
  plan.has_cross_wall = place_cross_walls(building);
  check_bends(building, plan);
  check_crossings(building, plan);
  return plan;
}

}  // namespace enfilade
