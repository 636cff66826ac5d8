#include "report/survey/glare.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace enfilade {
namespace {

/// Of a source at height H above the line of sight and T aside of it, seen over the distance R.
double index_at(double t_by_r, double h_by_r) {
  return position_index({1, 0, 0}, glm::normalize(Vec3(1.0, t_by_r, h_by_r)));
}

TEST(PositionIndex, HasTheValuesOfCie117sTable) {
  EXPECT_DOUBLE_EQ(index_at(0.0, 0.0), 1.0);
  const std::pair<double, double> above[] = {{0.1, 1.26}, {0.2, 1.53}, {0.5, 2.86}, {1.0, 7.00}};
  for (const auto& [height, index] : above)
    EXPECT_NEAR(index_at(0.0, height), index, 0.03 * index) << height;
}

TEST(PositionIndex, DoesNotDependOnTheSideOrOnTheTurnOfTheView) {
  EXPECT_DOUBLE_EQ(index_at(0.7, 0.4), index_at(-0.7, 0.4));
  const double c = std::cos(0.6), s = std::sin(0.6);
  const Vec3 source = glm::normalize(Vec3(1.0, 0.7, 0.4));
  EXPECT_NEAR(position_index({c, s, 0.0},
                             {c * source.x - s * source.y, s * source.x + c * source.y, source.z}),
              index_at(0.7, 0.4), 1e-9);
}

TEST(PositionIndex, BelowTheLineOfSightIsIwataAndTokuras) {
  EXPECT_NEAR(index_at(0.0, -0.5), 1.0 + 0.8 * 0.5, 1e-9);
  EXPECT_NEAR(index_at(0.0, -1.0), 1.0 + 1.2 * 1.0, 1e-9);
  EXPECT_DOUBLE_EQ(index_at(0.0, -100.0), 16.0);
}

}  // namespace
}  // namespace enfilade
