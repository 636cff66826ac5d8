// Random points of patches.
#include <gtest/gtest.h>

#include "base/random.hpp"
#include "hierarchy/patch_shape.hpp"
#include "unit/statistics.hpp"

namespace enfilade {
namespace {

TEST(PatchShape, PointsInQuartersCoverARectangleEvenly) {
  // A turned rectangle of 3 x 1, its coordinates read off along its sides.
  const Vec2 e1 = glm::normalize(Vec2(3, 1)), e2{-e1.y, e1.x}, origin(5, -2);
  const PatchShape shape =
      PatchShape::from({origin, origin + 3.0 * e1, origin + 3.0 * e1 + e2, origin + e2});
  Random random(1);
  testing::UnitSquareCounts all(12);
  for (int quarter = 0; quarter < 4; ++quarter) {
    testing::UnitSquareCounts one(12);
    int sides = -1;
    for (int i = 0; i < 50000; ++i) {
      const double r1 = random.uniform(), r2 = random.uniform();
      const Vec2 d = shape.point_in_quarter(quarter, r1, r2) - origin;
      const double x = glm::dot(d, e1) / 3.0, y = glm::dot(d, e2);
      all.add(x, y);
      const int here = (x < 0.5 ? 0 : 1) + (y < 0.5 ? 0 : 2);
      if (sides < 0) sides = here;
      ASSERT_EQ(here, sides) << "a quarter has points of another";
      one.add(2.0 * x - (here & 1), 2.0 * y - here / 2);
    }
    EXPECT_TRUE(one.are_uniform(5));
  }
  EXPECT_TRUE(all.are_uniform(5));
}

/// On other shapes the points' mean is the quarters' own on average: no light is shifted.
TEST(PatchShape, PointsInQuartersOfATriangleHaveItsCentroidNearby) {
  const PatchShape shape = PatchShape::from({{0, 0}, {3, 0}, {0, 2}});
  Random random(2);
  testing::Samples x, y;
  for (int i = 0; i < 100000; ++i) {
    const double r1 = random.uniform(), r2 = random.uniform();
    const Vec2 p = shape.point_in_quarter(i % 4, r1, r2);
    ASSERT_GE(p.x, -1e-12);
    ASSERT_GE(p.y, -1e-12);
    ASSERT_LE(2.0 * p.x + 3.0 * p.y, 6.0 + 1e-12);
    x.add(p.x);
    y.add(p.y);
  }
  // The rule is documented as approximate: within a tenth of the standard deviations.
  EXPECT_NEAR(x.mean(), shape.centroid.x, 0.1 * std::sqrt(shape.cxx));
  EXPECT_NEAR(y.mean(), shape.centroid.y, 0.1 * std::sqrt(shape.cyy));
}

}  // namespace
}  // namespace enfilade
