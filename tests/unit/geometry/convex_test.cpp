#include "geometry/convex.hpp"

#include <gtest/gtest.h>

namespace enfilade {
namespace {

TEST(ConvexHull, KeepsTheEndsOfColumnsThatRoundingBent) {
  // A column of points whose coordinates across it differ by rounding only, in the worst order.
  for (int pattern = 0; pattern < 27; ++pattern) {
    const auto off = [&](int digit) {
      int rest = pattern;
      for (int k = 0; k < digit; ++k) rest /= 3;
      return (rest % 3 - 1) * 4e-16;
    };
    const std::vector<Vec3> points{{2.6, 0, 2.11 + off(0)},   {4.3531, 0, 2.11 + off(1)},
                                   {3.555, 0, 2.11 + off(2)}, {2.6, 0, 1.269},
                                   {4.3531, 0, 1.269},        {3.0, 0, 1.5}};
    const Polygon hull = convex_hull(points, {0, 1, 0});
    EXPECT_NEAR(area_m2(hull), 1.7531 * 0.841, 1e-12) << pattern;
    EXPECT_EQ(hull.size(), 4u) << pattern;
    EXPECT_GT(normal(hull).y, 0.99);
  }
}

TEST(ConvexHull, KeepsOneOfTwoVerticesInOnePlace) {
  for (const double noise : {0.0, 1e-15, -1e-15}) {
    const std::vector<Vec3> points{{0, 0, 0},         {1, 0, 0}, {1 + noise, noise, 0}, {1, 1, 0},
                                   {1, 1 + noise, 0}, {0, 1, 0}, {noise, 0, 0}};
    EXPECT_NEAR(area_m2(convex_hull(points, {0, 0, 1})), 1.0, 1e-12);
  }
}

TEST(Region, CutsKeepTheVolume) {
  const std::vector<Vec3> corners{{0, 0, 0}, {3, 2, 1}};
  const Region box = box_region(corners, {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}, 0.0);
  EXPECT_NEAR(volume_m3(box), 6.0, 1e-12);
  const Vec3 n = glm::normalize(Vec3(1, 2, -0.5));
  const Plane plane{n, glm::dot(n, Vec3(1.2, 0.9, 0.4))};
  const auto [front, behind] = split_region(box, plane, cross_section(box, plane));
  EXPECT_NEAR(volume_m3(front) + volume_m3(behind), 6.0, 1e-12);
  EXPECT_GT(volume_m3(front), 1.0);
  EXPECT_GT(volume_m3(behind), 1.0);
}

}  // namespace
}  // namespace enfilade
