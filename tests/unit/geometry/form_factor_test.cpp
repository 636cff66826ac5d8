#include "geometry/form_factor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace enfilade {
namespace {

using std::numbers::pi;

TEST(PointToPolygon, CentredParallelSquareMatchesTheClosedForm) {
  // Howell's catalogue B-4 (four quarter rectangles): sides 2a, distance c.
  for (const double a : {0.1, 0.5, 3.0}) {
    for (const double c : {0.01, 1.0, 7.0}) {
      const std::vector<Vec3> square{{-a, -a, c}, {-a, a, c}, {a, a, c}, {a, -a, c}};  // faces down
      const double x = a / c, s = std::sqrt(1 + x * x);
      const double quarter = (x / s * std::atan(x / s) * 2.0) / (2.0 * pi);
      EXPECT_NEAR(point_to_polygon({0, 0, 0}, {0, 0, 1}, square), 4.0 * quarter, 1e-12);
    }
  }
}

TEST(PointToPolygon, IsZeroFromBehindAndBelowTheHorizon) {
  const std::vector<Vec3> square{{-1, -1, 1}, {-1, 1, 1}, {1, 1, 1}, {1, -1, 1}};
  EXPECT_EQ(point_to_polygon({0, 0, 2}, {0, 0, -1}, square), 0.0);  // behind it
  EXPECT_EQ(point_to_polygon({0, 0, 0}, {0, 0, -1}, square), 0.0);  // looking away
}

TEST(PointToPolygon, PartsOfAClosedBoxSumToOne) {
  const std::vector<std::vector<Vec3>> walls{{{0, 0, 2.5}, {0, 4, 2.5}, {3, 4, 2.5}, {3, 0, 2.5}},
                                             {{0, 0, 0}, {0, 4, 0}, {0, 4, 2.5}, {0, 0, 2.5}},
                                             {{3, 0, 0}, {3, 0, 2.5}, {3, 4, 2.5}, {3, 4, 0}},
                                             {{0, 0, 0}, {0, 0, 2.5}, {3, 0, 2.5}, {3, 0, 0}},
                                             {{0, 4, 0}, {3, 4, 0}, {3, 4, 2.5}, {0, 4, 2.5}}};
  for (const Vec3 x : {Vec3(0.01, 0.02, 0), Vec3(1.5, 2, 0), Vec3(2.999, 3.9, 0)}) {
    double sum = 0.0;
    for (const auto& wall : walls) sum += point_to_polygon(x, {0, 0, 1}, wall);
    EXPECT_NEAR(sum, 1.0, 1e-12);
  }
}

TEST(PointToPolygon, ClipsAtTheHorizon) {
  // A wall that starts far below the floor counts as if it began at the floor.
  const std::vector<Vec3> deep{{1, -1, -5}, {1, -1, 1}, {1, 1, 1}, {1, 1, -5}};
  const std::vector<Vec3> shallow{{1, -1, 0}, {1, -1, 1}, {1, 1, 1}, {1, 1, 0}};
  const double f = point_to_polygon({0, 0, 0}, {0, 0, 1}, shallow);
  EXPECT_GT(f, 0.05);
  EXPECT_NEAR(point_to_polygon({0, 0, 0}, {0, 0, 1}, deep), f, 1e-12);
}

TEST(PointKernel, AgreesWithASmallPolygon) {
  const double h = 1e-3;
  const std::vector<Vec3> tiny{
      {2 - h, 1 - h, 3}, {2 - h, 1 + h, 3}, {2 + h, 1 + h, 3}, {2 + h, 1 - h, 3}};
  const double kernel = point_kernel({0, 0, 0}, {0, 0, 1}, {2, 1, 3}, {0, 0, -1});
  EXPECT_NEAR(point_to_polygon({0, 0, 0}, {0, 0, 1}, tiny) / (4 * h * h), kernel, 1e-5 * kernel);
}

TEST(SolidAngle, AFaceOfACubeIsASixthOfTheSphereAndAHalfSpaceIsHalf) {
  const std::vector<Vec3> face{{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}};
  EXPECT_NEAR(solid_angle({0, 0, 0}, face), 4.0 * pi / 6.0, 1e-12);
  EXPECT_NEAR(solid_angle({0, 0, 2}, face), 4.0 * pi / 6.0, 1e-12);  // from the other side
  EXPECT_NEAR(solid_angle({0, 0, 1.0 - 1e-6}, face), 2.0 * pi, 1e-5);
}

}  // namespace
}  // namespace enfilade
