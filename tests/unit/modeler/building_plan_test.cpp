#include "modeler/building_plan.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "unit/modeler/buildings.hpp"

namespace enfilade {
namespace {

Building bent(int bays, double turn_deg) {
  Building b;
  b.wings = {{bays, turn_deg}};
  return b;
}

TEST(BuildingPlan, AnArcsChordsAreThoseOfOneCircle) {
  const Building building = bent(12, 90.0);
  const BuildingPlan plan = plan_building(building);
  const double step = 0.5 * std::numbers::pi / 12;
  const double radius = 0.5 * building.bay_width_m / std::sin(0.5 * step);
  // The path sets out along +x and turns left.
  const Vec2 centre(0.0, radius);
  for (const Bay& bay : plan.bays) {
    EXPECT_NEAR(glm::length(bay.start.at - centre), radius, 1e-9);
    EXPECT_NEAR(glm::length(bay.end.at - centre), radius, 1e-9);
  }
}

TEST(BuildingPlan, NeighboursMeetInOneLine) {
  Building building;
  building.wings = {{4, 0.0}, {6, 40.0}, {5, -30.0}};
  const BuildingPlan plan = plan_building(building);
  for (std::size_t i = 1; i < plan.bays.size(); ++i) {
    for (const double beside : {-5.0, -1.1, 0.0, 1.1, 5.0}) {
      const Vec2 a = plan.bays[i - 1].meet(BayEnd::end, 0.0, beside);
      const Vec2 b = plan.bays[i].meet(BayEnd::start, 0.0, beside);
      EXPECT_LT(glm::length(a - b), 1e-9) << i << " " << beside;
    }
  }
}

TEST(BuildingPlan, ARoomsRectangleStandsInsideIt) {
  for (const double turn : {0.0, 35.0, -35.0}) {
    const Building building = bent(5, turn);
    for (const Bay& bay : plan_building(building).bays) {
      for (const BaySide side : {BaySide::left, BaySide::right}) {
        const ModelRoom room = plan_room(building, bay, side);
        for (const double x : {0.0, room.width_m}) {
          for (const double y : {0.0, room.depth_m}) {
            const Vec2 p = room.world(x, y);
            for (std::size_t i = 0; i < 4; ++i) {
              const Vec2 a = room.corners[i], e = room.corners[(i + 1) % 4] - a;
              EXPECT_GE((e.x * (p.y - a.y) - e.y * (p.x - a.x)) / glm::length(e), -1e-9);
            }
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace enfilade
