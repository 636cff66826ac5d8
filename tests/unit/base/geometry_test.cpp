#include "base/geometry.hpp"

#include <gtest/gtest.h>

namespace enfilade {
namespace {

TEST(Box, LongestAxisIsTheFirstOfEquals) {
  EXPECT_EQ((Box{Vec3(0), Vec3(2, 1, 1)}.longest_axis()), 0);
  EXPECT_EQ((Box{Vec3(0), Vec3(1, 2, 2)}.longest_axis()), 1);
  EXPECT_EQ((Box{Vec3(0), Vec3(1, 1, 2)}.longest_axis()), 2);
  EXPECT_EQ((Box{Vec3(0), Vec3(1, 1, 1)}.longest_axis()), 0);
}

TEST(Box, CornersAreNumberedByTheirBits) {
  const auto corners = Box{Vec3(0, 1, 2), Vec3(3, 4, 5)}.corners();
  EXPECT_EQ(corners[0], Vec3(0, 1, 2));
  EXPECT_EQ(corners[1], Vec3(3, 1, 2));
  EXPECT_EQ(corners[2], Vec3(0, 4, 2));
  EXPECT_EQ(corners[7], Vec3(3, 4, 5));
}

TEST(LeastAxis, IsTheAxisFarthestFromTheDirection) {
  EXPECT_EQ(least_axis({0.1, -2, 1}), Vec3(1, 0, 0));
  EXPECT_EQ(least_axis({-3, 0.5, 1}), Vec3(0, 1, 0));
  EXPECT_EQ(least_axis({3, 2, -1}), Vec3(0, 0, 1));
  EXPECT_EQ(least_axis({1, 1, 1}), Vec3(1, 0, 0));
}

TEST(Cross2, IsPositiveForALeftTurn) {
  EXPECT_EQ(cross2({1, 0}, {0, 2}), 2.0);
  EXPECT_EQ(cross2({0, 2}, {1, 0}), -2.0);
}

}  // namespace
}  // namespace enfilade
