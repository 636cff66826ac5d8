#include "cells/rooms/leaks.hpp"

#include <gtest/gtest.h>

#include "cells/rooms/build_cells.hpp"
#include "unit/cells/rooms/plan_scenes.hpp"

namespace enfilade {
namespace {

struct Found {
  CellComplex complex;
  std::vector<Leak> leaks;
};

Found find(const plan::Plan& plan) {
  Found found;
  found.complex = build_cells(plan.pieces(), CellComplex::Config{}, found.leaks);
  return found;
}

/// The way starts in a cell and ends in the open, and no part of it crosses one of the polygons.
void expect_open_way(const Found& found, const plan::Plan& plan, CellId cell, const Leak& leak) {
  EXPECT_EQ(leak.cell, cell);
  ASSERT_GE(leak.path.size(), 3u);
  EXPECT_EQ(found.complex.locate(leak.path.front()), cell);
  const CellId last = found.complex.locate(leak.path.back());
  ASSERT_TRUE(last.valid());
  EXPECT_EQ(found.complex.cells()[last.index()].kind, CellKind::outside);
  for (std::size_t i = 0; i + 1 < leak.path.size(); ++i) {
    const Vec3 a = leak.path[i], b = leak.path[i + 1];
    for (const Polygon& polygon : plan.polygons) {
      const Plane plane = plane_of(polygon);
      const double from = plane.signed_distance(a), to = plane.signed_distance(b);
      if (from * to >= 0.0) continue;
      const Vec3 hit = a + from / (from - to) * (b - a);
      bool inside = true;
      for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vec3 edge = polygon[(k + 1) % polygon.size()] - polygon[k];
        inside &= glm::dot(glm::cross(edge, hit - polygon[k]), plane.n) > 1e-6;
      }
      EXPECT_FALSE(inside) << "part " << i << " of the way goes through a wall";
    }
  }
}

/// two_rooms without the wall x = 0 of the left one, of which `left_m` remains at the bottom.
plan::Plan without_a_wall(double remains_m) {
  plan::Plan plan = plan::two_rooms();
  plan.polygons.erase(plan.polygons.begin() + 1);
  plan.rectangle({0, 0, 0}, {0, 4, 0}, {0, 0, remains_m});
  return plan;
}

TEST(Leaks, AClosedBuildingAndAWindowHaveNone) {
  EXPECT_TRUE(find(plan::two_rooms()).leaks.empty());
  plan::Plan window = without_a_wall(1.0);
  window.rectangle({0, 0, 2}, {0, 4, 0}, {0, 0, 0.5});
  window.rectangle({0, 0, 1}, {0, 1, 0}, {0, 0, 1});
  window.rectangle({0, 3, 1}, {0, 1, 0}, {0, 0, 1});
  EXPECT_TRUE(find(window).leaks.empty());
}

TEST(Leaks, AMissingWallIsReportedWithAWayOut) {
  plan::Plan plan = without_a_wall(0.4);
  const auto move = plan::turn_and_move(100.0);
  plan.transform(move);
  const Found found = find(plan);
  ASSERT_EQ(found.leaks.size(), 1u);
  EXPECT_EQ(found.leaks[0].kind, LeakKind::open_side);
  EXPECT_NEAR(found.leaks[0].area_m2, 4.0 * 2.1, 1e-6);
  expect_open_way(found, plan, found.complex.locate(move({2, 2, 1})), found.leaks[0]);
  EXPECT_NE(found.complex.locate(move({8, 2, 1})), found.complex.locate(move({2, 2, 1})));
}

TEST(Leaks, AGapOfMillimetresIsReportedAndBreaksNoRoom) {
  const plan::Plan plan = without_a_wall(2.495);
  const Found found = find(plan);
  ASSERT_EQ(found.leaks.size(), 1u);
  EXPECT_EQ(found.leaks[0].kind, LeakKind::gap);
  EXPECT_NEAR(found.leaks[0].width_m, 0.005, 1e-6);
  expect_open_way(found, plan, found.complex.locate({2, 2, 1}), found.leaks[0]);
  EXPECT_EQ(found.complex.cells().size(), 3u);
  // What shines through it is still seen: the gap is a portal.
  EXPECT_EQ(found.complex.portals().size(), 2u);
}

TEST(Leaks, ARoomThatIsTooOpenIsLostToTheOutside) {
  // The left room keeps its floor and ceiling and the wall with the door; of its other three walls,
  // the lowest fifth.
  plan::Plan plan = plan::two_rooms();
  std::erase_if(plan.polygons, [](const Polygon& p) {
    const Box box = bounds(p);
    return box.hi.x == 0.0 || box.hi.y == 0.0 || (box.lo.y == 4.0 && box.hi.x == 10.0);
  });
  const Vec3 z(0, 0, 2.5), strip(0, 0, 0.5);
  plan.rectangle({4, 0, 0}, z, {6, 0, 0});
  plan.rectangle({4, 4, 0}, {6, 0, 0}, z);
  plan.rectangle({0, 0, 0}, {0, 4, 0}, strip);
  plan.rectangle({0, 0, 0}, strip, {4, 0, 0});
  plan.rectangle({0, 4, 0}, {4, 0, 0}, strip);
  const Found found = find(plan);
  ASSERT_EQ(found.leaks.size(), 1u);
  EXPECT_EQ(found.leaks[0].kind, LeakKind::lost_room);
  EXPECT_LT(glm::distance(found.leaks[0].path.front(), Vec3(2, 2, 1.25)), 0.1);
  const CellId left = found.complex.locate({2, 2, 1}), right = found.complex.locate({8, 2, 1});
  ASSERT_TRUE(left.valid() && right.valid());
  EXPECT_EQ(found.complex.cells()[left.index()].kind, CellKind::outside);
  EXPECT_EQ(found.complex.cells()[right.index()].kind, CellKind::room);
}

TEST(Leaks, ARoomWithoutOneOfItsWallsIsReportedWhereNoWallRunsOn) {
  // Not one polygon in the plane of the wall that is missing.
  plan::Plan plan = plan::two_rooms();
  std::erase_if(plan.polygons, [](const Polygon& p) { return bounds(p).hi.x == 0.0; });
  const auto move = plan::turn_and_move(100.0);
  plan.transform(move);
  const Found found = find(plan);
  ASSERT_EQ(found.leaks.size(), 1u);
  EXPECT_EQ(found.leaks[0].kind, LeakKind::lost_room);
  ASSERT_EQ(found.leaks[0].path.size(), 2u);
  EXPECT_LT(glm::distance(found.leaks[0].path.front(), move({2, 2, 1.25})), 0.3);
  EXPECT_LT(glm::distance(found.leaks[0].path.back(), move({0, 2, 1.25})), 0.3);
  EXPECT_NEAR(found.leaks[0].area_m2, 10.0, 0.2);
  EXPECT_NEAR(found.leaks[0].width_m, 2.5, 0.05);
  const CellId right = found.complex.locate(move({8, 2, 1}));
  ASSERT_TRUE(right.valid());
  EXPECT_EQ(found.complex.cells()[right.index()].kind, CellKind::room);
}

TEST(Leaks, AWallThatASingleRoomLacksIsReportedForItsOneCell) {
  for (std::size_t side = 0; side < 6; ++side) {
    plan::Plan plan = plan::one_room();
    const Polygon missing = plan.polygons[side];
    plan.polygons.erase(plan.polygons.begin() + static_cast<std::ptrdiff_t>(side));
    const Found found = find(plan);
    EXPECT_EQ(found.complex.cells().size(), 1u);
    ASSERT_EQ(found.leaks.size(), 1u) << side;
    EXPECT_EQ(found.leaks[0].kind, LeakKind::open_side);
    EXPECT_EQ(found.leaks[0].cell, CellId(0));
    EXPECT_NEAR(found.leaks[0].area_m2, area_m2(missing), 1e-6);
    ASSERT_EQ(found.leaks[0].path.size(), 2u);
    EXPECT_LT(glm::distance(found.leaks[0].path.back(), centroid(missing)), 0.02);
  }
}

TEST(Leaks, ARingAroundAPanelIsAsNarrowAsItsSides) {
  for (const double ring_m : {0.01, 0.04}) {
    plan::Plan plan = plan::two_rooms();
    std::erase_if(plan.polygons, [](const Polygon& p) { return bounds(p).hi.x == 0.0; });
    plan.rectangle({0, 0, 0}, {0, 4, 0}, {0, 0, 0.5});
    plan.rectangle({0, 0, 2}, {0, 4, 0}, {0, 0, 0.5});
    plan.rectangle({0, 0, 0.5}, {0, 1, 0}, {0, 0, 1.5});
    plan.rectangle({0, 3, 0.5}, {0, 1, 0}, {0, 0, 1.5});
    plan.rectangle({0, 1 + ring_m, 0.5 + ring_m}, {0, 2 - 2 * ring_m, 0}, {0, 0, 1.5 - 2 * ring_m});
    const Found found = find(plan);
    ASSERT_EQ(found.leaks.size(), 1u) << ring_m;
    EXPECT_EQ(found.leaks[0].kind, LeakKind::gap);
    EXPECT_NEAR(found.leaks[0].width_m, ring_m, 1e-6);
    expect_open_way(found, plan, found.complex.locate({2, 2, 1}), found.leaks[0]);
  }
}

TEST(Leaks, OfTwoGapsTheMoreOpenOneIsReported) {
  // A slit along the top of a wall and down one side of it has the larger hull, a wider one in the
  // other wall of that room more that is open.
  plan::Plan plan = plan::two_rooms();
  std::erase_if(plan.polygons,
                [](const Polygon& p) { return bounds(p).hi.x == 0.0 || bounds(p).hi.y == 0.0; });
  plan.rectangle({0, 0.01, 0}, {0, 3.99, 0}, {0, 0, 2.49});
  plan.rectangle({0, 0, 0}, {0, 0, 2.45}, {4, 0, 0});
  plan.rectangle({4, 0, 0}, {0, 0, 2.5}, {6, 0, 0});
  const Found found = find(plan);
  ASSERT_EQ(found.leaks.size(), 1u);
  EXPECT_EQ(found.leaks[0].kind, LeakKind::gap);
  EXPECT_NEAR(found.leaks[0].width_m, 0.05, 1e-6);
  EXPECT_NEAR(found.leaks[0].area_m2, 4 * 0.05, 1e-6);
  expect_open_way(found, plan, found.complex.locate({2, 2, 1}), found.leaks[0]);
}

TEST(Leaks, ACourtBetweenThreeWallsIsNoLostRoom) {
  plan::Plan plan = plan::two_rooms();
  const Vec3 z(0, 0, 2.5);
  plan.rectangle({4, 4, 0}, {6, 0, 0}, {0, 4, 0});  // its ground
  plan.rectangle({4, 4, 0}, z, {6, 0, 0});
  plan.rectangle({4, 8, 0}, {6, 0, 0}, z);
  plan.rectangle({10, 4, 0}, z, {0, 4, 0});
  const Found found = find(plan);
  EXPECT_TRUE(found.leaks.empty());
}

}  // namespace
}  // namespace enfilade
