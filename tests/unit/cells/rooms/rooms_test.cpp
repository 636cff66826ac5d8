// Rooms that no wall parts, and the rooms of a real house.
#include <gtest/gtest.h>

#include <algorithm>

#include "cells/rooms/build_cells.hpp"
#include "scene_file/scene_io.hpp"
#include "unit/cells/rooms/plan_scenes.hpp"
#include "unit/cells/rooms/room_score.hpp"
#include "unit/source_files.hpp"

namespace enfilade {
namespace {

CellComplex build_rooms(const plan::Plan& plan) {
  return build_cells(plan.pieces(), CellComplex::Config{});
}

long count_rooms(const CellComplex& complex) {
  return std::count_if(complex.cells().begin(), complex.cells().end(),
                       [](const Cell& cell) { return cell.kind == CellKind::room; });
}

/// 8 x 4 m, its floor `step_m` higher where x < 5.
plan::Plan stepped_room(double step_m) {
  plan::Plan plan;
  const double h = 2.5;
  const Vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  plan.rectangle({0, 0, step_m}, 5.0 * x, 4.0 * y);
  plan.rectangle({5, 0, 0}, 3.0 * x, 4.0 * y);
  plan.rectangle({5, 0, 0}, 4.0 * y, step_m * z);
  plan.rectangle({0, 0, h}, 4.0 * y, 8.0 * x);
  plan.rectangle({0, 0, step_m}, 4.0 * y, (h - step_m) * z);
  plan.rectangle({8, 0, 0}, h * z, 4.0 * y);
  plan.rectangle({0, 0, step_m}, (h - step_m) * z, 5.0 * x);
  plan.rectangle({5, 0, 0}, h * z, 3.0 * x);
  plan.rectangle({0, 4, step_m}, 5.0 * x, (h - step_m) * z);
  plan.rectangle({5, 4, 0}, 3.0 * x, h * z);
  return plan;
}

TEST(FloorSteps, AStepFromWallToWallPartsTwoRooms) {
  for (const double step_m : {0.006, 0.3}) {
    plan::Plan plan = stepped_room(step_m);
    plan.transform(plan::turn_and_move(100.0));
    const CellComplex complex = build_rooms(plan);
    EXPECT_EQ(complex.open_cells(), 2u) << step_m;
    ASSERT_EQ(complex.portals().size(), 1u) << step_m;
    EXPECT_NEAR(area_m2(complex.portals()[0].polygon), 4.0 * (2.5 - step_m), 1e-6);
  }
}

TEST(FloorSteps, APlatformALowWallAndABeamPartNothing) {
  plan::Plan platform = plan::one_room();
  platform.box({0, 0, 0}, {0.6, 4, 0.3}, false);
  EXPECT_EQ(count_rooms(build_rooms(platform)), 1);
  plan::Plan wall = plan::one_room();
  wall.box({2.4, 0, 0}, {2.5, 4, 0.5}, false);
  EXPECT_EQ(count_rooms(build_rooms(wall)), 1);
  plan::Plan beam = plan::one_room();
  beam.box({2.4, 0, 2.2}, {2.6, 4, 2.5}, false);
  EXPECT_EQ(count_rooms(build_rooms(beam)), 1);
}

/// Two storeys with a flight of 14 treads up through the hole between them.
plan::Plan two_storeys_with_stairs() {
  plan::Plan plan = plan::two_storeys();
  for (int i = 1; i < 14; ++i) {
    const double z = 0.2 * i, y = 3.0 / 14.0 * i;
    plan.box({0, y, z - 0.04}, {2, y + 3.0 / 14.0, z}, false);
  }
  return plan;
}

TEST(Stairwells, AFlightOfStairsIsACellBetweenTwoStoreys) {
  plan::Plan plan = two_storeys_with_stairs();
  const auto move = plan::turn_and_move(100.0);
  plan.transform(move);
  const CellComplex complex = build_rooms(plan);
  EXPECT_EQ(count_rooms(complex), 3);
  const CellId below = complex.locate(move({6, 4, 1})), above = complex.locate(move({6, 4, 4}));
  const CellId stairs = complex.locate(move({1, 1.5, 2.6}));
  EXPECT_NE(below, above);
  EXPECT_NE(stairs, below);
  EXPECT_NE(stairs, above);
  EXPECT_NEAR(complex.cells()[stairs.index()].volume_m3, 2.0 * 3.0 * 5.8, 0.1);
  for (const Portal& portal : complex.portals()) {
    EXPECT_TRUE(portal.a == stairs || portal.b == stairs);
  }
}

TEST(RealHouse, EveryRoomAndDoorOfTheDuplexIsFound) {
  const std::string file = source_file("scenes/duplex.json");
  const KnownBuilding building = read_known_building(file);
  ASSERT_EQ(building.rooms.size(), 21u);
  ASSERT_EQ(building.doors.size(), 14u);
  Warnings warnings;
  Scene scene = read_scene(file, warnings);
  // Still, then turned and a thousand kilometres off.
  static const auto turn = plan::turn_and_move(1e6);
  const auto stay = [](const Vec3& p) { return p; };
  const auto move = [](const Vec3& p) { return turn(p); };
  std::size_t cells = 0;
  for (const bool moved : {false, true}) {
    if (moved) {
      for (Surface& surface : scene.surfaces) {
        for (Vec3& p : surface.vertices) p = move(p);
      }
    }
    const CellComplex complex = build_cells(make_pieces(scene, warnings), CellComplex::Config{});
    const RoomScore score = moved ? score_rooms(building, complex, 0.2, move)
                                  : score_rooms(building, complex, 0.2, stay);
    for (const auto& room : score.rooms) {
      // The roof is open to the sky.
      EXPECT_TRUE(room.iou >= 0.5 || room.name == "R301 Roof") << room.name << ' ' << room.iou;
    }
    EXPECT_GE(score.rooms_share(), 0.95);
    EXPECT_GE(score.doors_share(), 0.95);
    EXPECT_LE(complex.open_cells(), 27u);  // 1.3 a room
    if (moved) {
      EXPECT_EQ(complex.open_cells(), cells);
    }
    cells = complex.open_cells();
  }
}

}  // namespace
}  // namespace enfilade
