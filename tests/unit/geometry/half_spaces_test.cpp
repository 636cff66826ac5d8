#include "geometry/half_spaces.hpp"

#include <gtest/gtest.h>

namespace enfilade {
namespace {

Polygon square_at(double x, double half) {
  return {{x, -half, -half}, {x, half, -half}, {x, half, half}, {x, -half, half}};
}

/// From a square of half side 1 at x = 0 through a window of half side 1 at x = 1: at x = 2 lines
/// reach as far as 3 from the axis.
HalfSpaces seen_through_a_window() {
  HalfSpaces spaces;
  add_penumbra(square_at(0.0, 1.0), square_at(1.0, 1.0), {1, 0, 0}, 1e-9, spaces);
  return spaces;
}

TEST(Penumbra, ReachesAsFarAsTheExtremeLinesThroughTheWindow) {
  const HalfSpaces spaces = seen_through_a_window();
  ASSERT_EQ(spaces.size(), 4u);
  EXPECT_FALSE(outside(Box{Vec3(2, 2.9, 0), Vec3(2, 3.5, 0)}, spaces, 1e-6));
  EXPECT_TRUE(outside(Box{Vec3(2, 3.1, 0), Vec3(2, 3.5, 0)}, spaces, 1e-6));
}

TEST(Penumbra, ClipsWhatLiesBeyondTheWindow) {
  const HalfSpaces spaces = seen_through_a_window();
  const Polygon wide = square_at(2.0, 10.0);
  EXPECT_FALSE(outside(wide, spaces, 1e-6));
  EXPECT_NEAR(area_m2(clip_to(wide, spaces, 0.0)), 36.0, 1e-6);
  Polygon beside = square_at(2.0, 1.0);
  for (Vec3& p : beside) p.y += 5.0;
  EXPECT_TRUE(outside(beside, spaces, 1e-6));
  EXPECT_TRUE(clip_to(beside, spaces, 0.0).empty());
}

}  // namespace
}  // namespace enfilade
