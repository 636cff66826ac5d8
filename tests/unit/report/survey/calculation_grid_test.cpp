#include "report/survey/calculation_grid.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace enfilade {
namespace {

RoomPlan rectangle(double length, double width, double turn = 0.0) {
  const Vec2 u(std::cos(turn), std::sin(turn)), v(-u.y, u.x);
  return RoomPlan(std::vector<Vec2>{{0, 0}, length * u, length * u + width * v, width * v});
}

/// p = 0.2 * 5^log10(d) by hand: 5^0 = 1, 5^1 = 5, 5^2 = 25, 5^log10(2) = 1.62335.
TEST(CalculationGrid, HasTheStandardsNumberOfPoints) {
  EXPECT_NEAR(largest_spacing(2.0, 2.0), 0.32467, 1e-5);
  const std::pair<double, int> typical[] = {{1, 5}, {2, 6}, {5, 8}, {10, 10}, {100, 20}};
  for (const auto& [length_m, points] : typical)
    EXPECT_EQ(std::lround(length_m / largest_spacing(length_m, length_m)), points) << length_m;
  EXPECT_DOUBLE_EQ(largest_spacing(1000.0, 1000.0), 10.0);
}

TEST(CalculationGrid, GoesByTheShorterSideOfALongArea) {
  EXPECT_DOUBLE_EQ(largest_spacing(10.0, 5.1), 1.0);
  EXPECT_DOUBLE_EQ(largest_spacing(10.0, 5.0), largest_spacing(5.0, 5.0));
}

TEST(CalculationGrid, LeavesTheWallZoneOut) {
  EXPECT_DOUBLE_EQ(wall_zone(8.0, 5.0), 0.5);
  EXPECT_DOUBLE_EQ(wall_zone(8.0, 2.0), 0.3);
  const CalculationGrid grid = calculation_grid(rectangle(5.0, 4.0));
  EXPECT_EQ(grid.columns, 8);  // 4 m / 0.527 m = 7.6
  EXPECT_EQ(grid.rows, 6);     // 3 m / 0.5 m
  EXPECT_DOUBLE_EQ(grid.spacing_m, 0.5);
  ASSERT_EQ(grid.points.size(), 48u);
  EXPECT_NEAR(glm::length(grid.points[0] - Vec2(0.75, 0.75)), 0.0, 1e-12);
  EXPECT_NEAR(glm::length(grid.points[47] - Vec2(4.25, 3.25)), 0.0, 1e-12);
}

TEST(CalculationGrid, TurnsWithItsRoom) {
  const CalculationGrid straight = calculation_grid(rectangle(7.0, 4.0));
  const CalculationGrid turned = calculation_grid(rectangle(7.0, 4.0, 0.7));
  EXPECT_EQ(straight.points.size(), turned.points.size());
  EXPECT_NEAR(straight.spacing_m, turned.spacing_m, 1e-9);
}

TEST(CalculationGrid, KeepsOffAllWallsOfAnLShapedRoom) {
  const RoomPlan room(std::vector<Vec2>{{0, 0}, {6, 0}, {6, 2}, {2, 2}, {2, 5}, {0, 5}});
  const CalculationGrid grid = calculation_grid(room);
  ASSERT_GT(grid.points.size(), 5u);
  for (const Vec2& p : grid.points) {
    EXPECT_TRUE((p.x < 6 && p.y < 2) || (p.x < 2 && p.y < 5));
    EXPECT_GE(std::min({p.x, p.y, 6 - p.x, 5 - p.y}), 0.5 - 1e-9);
    EXPECT_GE(glm::length(p - Vec2(2, 2)), 0.5 - 1e-9);  // the corner that juts in
  }
  EXPECT_EQ(grid.points.size() + grid.outside,
            static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows));
}

TEST(CalculationGrid, HasAPointInTheNarrowestRoom) {
  // A ring 0.2 m wide about a square of 10 m: far narrower than the grid, and than its wall zone.
  std::vector<Polygon> ring;
  for (const auto& [x0, y0, x1, y1] : {std::array{0.0, 0.0, 10.0, 0.2},
                                       {0.0, 9.8, 10.0, 10.0},
                                       {0.0, 0.2, 0.2, 9.8},
                                       {9.8, 0.2, 10.0, 9.8}})
    ring.push_back({{x0, y0, 0}, {x1, y0, 0}, {x1, y1, 0}, {x0, y1, 0}});
  const RoomPlan room(ring);
  EXPECT_NEAR(room.area_m2(), 100.0 - 9.6 * 9.6, 1e-9);
  const CalculationGrid grid = calculation_grid(room);
  ASSERT_EQ(grid.points.size(), 1u);
  EXPECT_TRUE(room.contains(grid.points[0]));
  EXPECT_TRUE(calculation_grid(RoomPlan()).points.empty());
}

}  // namespace
}  // namespace enfilade
