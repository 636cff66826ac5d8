#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.hpp"
#include "cells/partition/cell_complex.hpp"
#include "cells/rooms/build_cells.hpp"
#include "unit/cells/rooms/plan_scenes.hpp"

namespace enfilade {
namespace {

CellComplex build(const plan::Plan& plan) {
  return build_cells(plan.pieces(), CellComplex::Config{});
}

long rooms_of(const CellComplex& complex) {
  return std::count_if(complex.cells().begin(), complex.cells().end(),
                       [](const Cell& cell) { return cell.kind == CellKind::room; });
}

TEST(BuildCells, EmptyRoomIsOneCellWithoutPortals) {
  const CellComplex complex = build(plan::one_room());
  ASSERT_EQ(complex.cells().size(), 1u);
  EXPECT_EQ(complex.cells()[0].kind, CellKind::room);
  EXPECT_NEAR(complex.cells()[0].volume_m3, 50.0, 1e-6);
  EXPECT_TRUE(complex.portals().empty());
  EXPECT_EQ(complex.locate({1, 1, 1}), CellId(0));
  EXPECT_FALSE(complex.locate({-1, 1, 1}).valid());
}

TEST(BuildCells, TheOutsideIsACellWhereADoorShowsItOrNothingEnclosesAnything) {
  EXPECT_FALSE(build(plan::one_room()).outside().valid());

  plan::Plan open;  // two walls of a room
  open.sheet({0, 0, 0}, {5, 0, 0}, {0, 0, 3});
  open.sheet({0, 0, 0}, {0, 4, 0}, {0, 0, 3});
  const CellComplex alone = build(open);
  ASSERT_TRUE(alone.outside().valid());
  EXPECT_EQ(alone.outside(), alone.locate({2, 2, 1}));

  plan::Plan house = plan::one_room();
  house.polygons.erase(house.polygons.begin() + 4);  // the wall at x = 5
  house.wall_with_door(5, 0, 4, 2.5, 1.5, 2.4, 2);
  const CellComplex seen = build(house);
  ASSERT_TRUE(seen.outside().valid());
  EXPECT_NE(seen.outside(), seen.locate({2, 2, 1}));
  EXPECT_EQ(seen.cells()[seen.outside().index()].kind, CellKind::outside);
}

TEST(BuildCells, FurnitureDoesNotCutARoom) {
  plan::Plan plan = plan::one_room();
  plan.box({1, 1, 0}, {2, 2, 0.8}, false);
  plan.box({3, 1, 0}, {3.4, 1.4, 1.2}, false);
  const CellComplex complex = build(plan);
  EXPECT_EQ(rooms_of(complex), 1);
  EXPECT_TRUE(complex.portals().empty());
  EXPECT_EQ(complex.locate({1.5, 0.5, 0.4}), complex.locate({4.5, 3.5, 2.4}));
}

TEST(BuildCells, ADoorIsOnePortalBetweenTwoRooms) {
  const CellComplex complex = build(plan::two_rooms());
  ASSERT_EQ(complex.cells().size(), 2u);
  ASSERT_EQ(complex.portals().size(), 1u);
  EXPECT_NEAR(area_m2(complex.portals()[0].polygon), 1.8, 1e-6);
  const CellId left = complex.locate({2, 2, 1}), right = complex.locate({8, 2, 1});
  EXPECT_NE(left, right);
  EXPECT_NEAR(complex.cells()[left.index()].volume_m3, 40.0, 1e-6);
  EXPECT_NEAR(complex.cells()[right.index()].volume_m3, 60.0, 1e-6);
}

TEST(BuildCells, AClosetBehindADoorInTheCornerIsARoom) {
  // 5 x 4 m with a closet 5 x 1 m, whose door stands at the side wall and is nearly as wide as what
  // it shares of the room's length there.
  plan::Plan plan;
  plan.box({0, 0, 0}, {5, 4, 2.5}, true);
  plan.wall_with_door(4, 0, 4, 2.5, 0, 0.8, 2);
  plan.box({1, 1, 0}, {1.8, 1.6, 0.7}, false);
  const CellComplex complex = build(plan);
  EXPECT_EQ(rooms_of(complex), 2);
  EXPECT_NE(complex.locate({2, 3, 1}), complex.locate({4.5, 3, 1}));
  EXPECT_TRUE(complex.locate({4.5, 3, 1}).valid());
}

TEST(BuildCells, TheLayersOfAWallAreNoRooms) {
  // Two rooms with a wall of two layers between them, each layer a solid of its own; between the
  // layers their faces lie on each other, so that either sees the other's front.
  plan::Plan plan;
  plan.box({0, 0, 0}, {4, 4, 2.5}, true);
  plan.box({4.3, 0, 0}, {9, 4, 2.5}, true);
  plan.box({4, 0, 0}, {4.1, 4, 2.5}, false);
  plan.box({4.1, 0, 0}, {4.3, 4, 2.5}, false);
  const CellComplex complex = build(plan);
  EXPECT_EQ(rooms_of(complex), 2);
  EXPECT_FALSE(complex.locate({4.05, 2, 1}).valid());
  EXPECT_FALSE(complex.locate({4.2, 2, 1}).valid());
}

TEST(BuildCells, PortalFacesItsCellA) {
  const CellComplex complex = build(plan::two_rooms());
  for (const Portal& portal : complex.portals()) {
    const Vec3 middle = centroid(portal.polygon), n = normal(portal.polygon);
    EXPECT_EQ(complex.locate(middle + 0.01 * n), portal.a);
    EXPECT_EQ(complex.locate(middle - 0.01 * n), portal.b);
  }
}

TEST(BuildCells, AWindowIsAPortalToTheOutside) {
  plan::Plan plan;
  plan.box({0, 0, 0}, {5, 4, 2.5}, true);
  plan.polygons.erase(plan.polygons.begin() + 1);  // x = 0
  plan.rectangle({0, 0, 0}, {0, 4, 0}, {0, 0, 1});
  plan.rectangle({0, 0, 2}, {0, 4, 0}, {0, 0, 0.5});
  plan.rectangle({0, 0, 1}, {0, 1, 0}, {0, 0, 1});
  plan.rectangle({0, 3, 1}, {0, 1, 0}, {0, 0, 1});
  const CellComplex complex = build(plan);
  ASSERT_EQ(complex.cells().size(), 2u);
  ASSERT_EQ(complex.portals().size(), 1u);
  EXPECT_NEAR(area_m2(complex.portals()[0].polygon), 2.0, 1e-6);
  const CellId outside = complex.locate({-1, 2, 1});
  ASSERT_TRUE(outside.valid());
  EXPECT_EQ(complex.cells()[outside.index()].kind, CellKind::outside);
}

TEST(BuildCells, StairHoleJoinsTwoStoreys) {
  const CellComplex complex = build(plan::two_storeys());
  EXPECT_EQ(rooms_of(complex), 2);
  EXPECT_FALSE(complex.locate({6, 4, 2.65}).valid());  // inside the slab
  EXPECT_NE(complex.locate({6, 4, 1}), complex.locate({6, 4, 4}));
  ASSERT_EQ(complex.portals().size(), 1u);
  EXPECT_NEAR(area_m2(complex.portals()[0].polygon), 6.0, 1e-6);
}

TEST(BuildCells, AnLIsOneRoom) {
  const CellComplex complex = build(plan::l_corridor());
  EXPECT_EQ(complex.cells().size(), 1u);
  EXPECT_EQ(complex.locate({5, 1, 1}), complex.locate({1, 5, 1}));
}

TEST(BuildCells, SoupIsOneCellEverywhere) {
  plan::Plan plan;
  for (int i = 0; i < 40; ++i) {
    const Vec3 at(std::sin(1.7 * i) * 5, std::cos(2.9 * i) * 5, std::sin(4.1 * i) * 5);
    plan.sheet(at, {std::cos(i), std::sin(i), 0.3}, {-std::sin(i), std::cos(i), 0.2});
  }
  const CellComplex complex = build(plan);
  EXPECT_EQ(complex.cells().size(), 1u);
  EXPECT_EQ(complex.locate({0, 0, 0}), CellId(0));
}

TEST(BuildCells, TurnedAndMovedGivesTheSameCells) {
  const CellComplex still = build(plan::two_storeys());
  plan::Plan plan = plan::two_storeys();
  const auto move = plan::turn_and_move(1e5);
  plan.transform(move);
  const CellComplex moved = build(plan);
  ASSERT_EQ(moved.cells().size(), still.cells().size());
  ASSERT_EQ(moved.portals().size(), still.portals().size());
  EXPECT_NEAR(area_m2(moved.portals()[0].polygon), area_m2(still.portals()[0].polygon), 1e-5);
  for (const Vec3& p : {Vec3(1, 1, 1), Vec3(7, 5, 5), Vec3(1, 1, 4)}) {
    EXPECT_NEAR(moved.cells()[moved.locate(move(p)).index()].volume_m3,
                still.cells()[still.locate(p).index()].volume_m3, 1e-4);
  }
}

TEST(BuildCells, CuttingKeepsAreaAndFacesTheCell) {
  const plan::Plan plan = plan::two_rooms();
  const CellComplex complex = build(plan);
  for (const Piece& piece : plan.pieces()) {
    double sum = 0.0;
    for (const CellPiece& part : complex.cut(piece)) {
      sum += area_m2(part.piece.polygon);
      EXPECT_EQ(part.piece.surface, piece.surface);
      EXPECT_EQ(complex.locate(centroid(part.piece.polygon) + 0.01 * normal(piece.polygon)),
                part.cell);
    }
    EXPECT_NEAR(sum, area_m2(piece.polygon), 1e-9 * sum);
  }
}

TEST(BuildCells, PiecesInOneCellStayWhole) {
  const plan::Plan plan = plan::l_corridor();
  const CellComplex complex = build(plan);
  for (const Piece& piece : plan.pieces()) {
    const auto parts = complex.cut(piece);
    ASSERT_EQ(parts.size(), 1u);
    EXPECT_EQ(parts[0].piece.polygon, piece.polygon);
  }
}

TEST(CellComplex, TheInsideOfASolidIsNoOpenCell) {
  std::vector<Cell> cells(4);
  cells[1].kind = CellKind::outside;
  cells[3].kind = CellKind::solid;
  EXPECT_EQ(CellComplex(cells, {}, {}, 1e-5).open_cells(), 3u);
}

TEST(ComplexBytes, ComeBackTheSame) {
  const CellComplex complex = build(plan::two_storeys());
  const std::string bytes = to_bytes(complex);
  const CellComplex back = complex_from_bytes(bytes);
  EXPECT_EQ(to_bytes(back), bytes);
  EXPECT_EQ(back.locate({6, 4, 4}), complex.locate({6, 4, 4}));
  EXPECT_THROW(complex_from_bytes(std::string_view(bytes).substr(0, bytes.size() - 3)), RunError);
  EXPECT_THROW(complex_from_bytes("something else altogether"), RunError);
}

}  // namespace
}  // namespace enfilade
