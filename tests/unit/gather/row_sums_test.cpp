#include "gather/row_sums.hpp"

#include <gtest/gtest.h>

#include "unit/gather/box_room.hpp"

namespace enfilade {
namespace {

TEST(RowSums, PercentilesAreThoseOfTheArea) {
  RowSums rows;
  // 2% of the area at 0.9 of its target, 95% right, 3% at 1.25.
  rows.add(2.0, 0.45, 0.5);
  rows.add(95.0, 1.0, 1.0);
  rows.add(3.0, 1.0, 0.8);
  EXPECT_NEAR(rows.mean_ratio(), (2.0 * 0.9 + 95.0 + 3.0 * 1.25) / 100.0, 1e-12);
  EXPECT_NEAR(rows.mean_deficit(), (2.0 * 0.05 + 3.0 * 0.2) / 100.0, 1e-12);
  EXPECT_NEAR(rows.percentile(0.01), 0.9, 0.02);
  EXPECT_NEAR(rows.percentile(0.5), 1.0, 3e-4);
  EXPECT_NEAR(rows.percentile(0.99), 1.25, 0.06);
  EXPECT_EQ(rows.closed_m2, 100.0);
}

TEST(RowSums, WhatIsFarOffIsKeptInTheLastCells) {
  RowSums rows;
  rows.add(1.0, 0.0, 1.0);
  rows.add(1.0, 50.0, 1.0);
  EXPECT_LT(rows.percentile(0.4), 0.3);
  EXPECT_GT(rows.percentile(0.9), 1.7);
  EXPECT_EQ(RowSums().percentile(0.5), 0.0);
  EXPECT_EQ(RowSums().mean_ratio(), 0.0);
}

/// The sums before they are closed: the furnace is right after that whatever they were.
TEST(RowSums, OfAnEmptyFurnaceAreOne) {
  for (const Basis basis : {Basis::constant, Basis::linear}) {
    const testing::Solved solved(testing::box_room({0, 0, 0}, {4, 3, 2.5}, {0.5}, {1.0}), basis,
                                 1e-4);
    const RowSums& rows = solved.figures.rows;
    EXPECT_NEAR(rows.closed_m2, 2.0 * (12.0 + 10.0 + 7.5), 1e-9);
    EXPECT_NEAR(rows.mean_ratio(), 1.0, 1e-3);
    EXPECT_GT(rows.percentile(0.01), 0.93);
    EXPECT_LT(rows.percentile(0.99), 1.07);
  }
}

TEST(RowSums, OfAFurnaceWithFurnitureAreOneOnAverage) {
  Scene scene = testing::box_room({0, 0, 0}, {4, 3, 2.5}, {0.5}, {1.0});
  testing::add_block(scene, {0.5, 0.5, 0.2}, {1.5, 1.2, 0.9}, {0.5}, {1.0});
  testing::add_block(scene, {2.5, 1.0, 0.5}, {2.6, 2.5, 2.0}, {0.5}, {1.0});
  for (Surface& surface : scene.surfaces) surface.object = "";  // links between single polygons
  const testing::Solved solved(scene, Basis::linear, 2e-5);
  const RowSums& rows = solved.figures.rows;
  EXPECT_NEAR(rows.mean_ratio(), 1.0, 2e-3);
  EXPECT_GT(rows.percentile(0.01), 0.95);
  EXPECT_LT(rows.percentile(0.99), 1.05);
}

}  // namespace
}  // namespace enfilade
