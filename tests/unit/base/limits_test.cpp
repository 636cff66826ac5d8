#include "base/limits.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace enfilade::limits {
namespace {

const double infinite = INFINITY;

TEST(Limits, OfPlaces) {
  EXPECT_FALSE(fault_of_place({1e9, -1e9, 0}));
  for (const double far : {1.1e9, -1e20, 1e300, infinite, std::nan("")})
    EXPECT_TRUE(fault_of_place({0, far, 0})) << far;
}

TEST(Limits, OfOpenings) {
  for (const Vec3& fine : {Vec3(0.0), Vec3(1e-6, 1e4, 0), Vec3(0.6, 0.3, 0.1)})
    EXPECT_FALSE(fault_of_opening(fine)) << fine.x;
  for (const double x : {1e-7, 1e-300, 1.1e4, 1e300, -1.0, infinite, std::nan("")})
    EXPECT_TRUE(fault_of_opening({0.6, x, 0})) << x;
}

TEST(Limits, OfLight) {
  for (const double light : {0.0, 1e-30, 1.0, 1e30}) EXPECT_FALSE(fault_of_light(light)) << light;
  for (const double light : {-1.0, 1e-31, 1e31, infinite, std::nan("")})
    EXPECT_TRUE(fault_of_light(light)) << light;
}

TEST(Limits, ADirectionMayHaveAnyLength) {
  for (const double length : {1e300, 1.0, 1e-300, 5e-324}) {
    const Vec3 v(0, length, -length);
    ASSERT_FALSE(fault_of_direction(v)) << length;
    EXPECT_NEAR(unit(v).y, std::sqrt(0.5), 1e-12) << length;
    EXPECT_NEAR(glm::length(unit(v)), 1.0, 1e-12) << length;
  }
  EXPECT_TRUE(fault_of_direction({0, 0, 0}));
  EXPECT_TRUE(fault_of_direction({0, infinite, 0}));
}

}  // namespace
}  // namespace enfilade::limits
