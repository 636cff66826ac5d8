#include "report/room_table/isolines.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace enfilade {
namespace {

GridField field(int columns, int rows, const std::function<double(double, double)>& value) {
  GridField made{columns, rows, {}};
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) made.values.push_back(value(column, row));
  }
  return made;
}

TEST(Isolines, OfAPlaneAreStraight) {
  const auto lines = isolines(field(5, 4, [](double x, double y) { return 2.0 * x + y; }), 4.5);
  ASSERT_EQ(lines.size(), 1u);
  for (const Vec2& p : lines[0]) EXPECT_NEAR(2.0 * p.x + p.y, 4.5, 1e-9);
  EXPECT_NEAR(std::abs(lines[0].front().y - lines[0].back().y), 3.0, 1e-9);
}

TEST(Isolines, RoundAHillAreClosed) {
  const auto hill = [](double x, double y) {
    return 10.0 - (x - 5.0) * (x - 5.0) - (y - 5.0) * (y - 5.0);
  };
  const auto lines = isolines(field(11, 11, hill), 3.3);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].front(), lines[0].back());
  for (const Vec2& p : lines[0]) EXPECT_NEAR(hill(p.x, p.y), 3.3, 0.6);  // bilinear, not quadratic
}

TEST(Isolines, EndWhereNoValueIsKnown) {
  GridField plane = field(5, 5, [](double x, double) { return x; });
  plane.values[2 + 5 * 2] = std::numeric_limits<double>::quiet_NaN();
  for (const auto& line : isolines(plane, 1.5)) {
    for (const Vec2& p : line) EXPECT_TRUE(p.y <= 1.0 + 1e-9 || p.y >= 3.0 - 1e-9);
  }
}

TEST(ScaleLevels, AreThoseOfTheStandardsScale) {
  EXPECT_EQ(scale_levels(90.0, 600.0, 10),
            (std::vector<double>{100.0, 150.0, 200.0, 300.0, 500.0}));
  EXPECT_LE(scale_levels(1.0, 1e4, 6).size(), 6u);
  EXPECT_TRUE(scale_levels(5.0, 5.0, 6).empty());
  EXPECT_TRUE(scale_levels(0.0, 0.0, 6).empty());
}

}  // namespace
}  // namespace enfilade
