#include "geometry/polygon.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/random.hpp"

namespace enfilade {
namespace {

Polygon square(double x0, double y0, double x1, double y1, double z = 0.0) {
  return {{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}};
}

double total_area(const std::vector<Polygon>& polygons) {
  double sum = 0.0;
  for (const Polygon& p : polygons) sum += area_m2(p);
  return sum;
}

Polygon regular(int sides, const Vec3& center, double radius, double phase) {
  Polygon p;
  for (int i = 0; i < sides; ++i) {
    const double a = phase + 2.0 * std::numbers::pi * i / sides;
    p.push_back(center + radius * Vec3(std::cos(a), std::sin(a), 0.0));
  }
  return p;
}

TEST(Polygon, AreaNormalAndCentroidAtAnyScaleAndOrigin) {
  for (const double scale : {1e-4, 1.0, 1e4}) {
    for (const double origin : {0.0, 1e6}) {
      const Vec3 o(origin, -origin, 0.5 * origin);
      const Polygon p{o, o + scale * Vec3(3, 0, 0), o + scale * Vec3(3, 0, 2),
                      o + scale * Vec3(0, 0, 2)};
      const double digits = scale < 1.0 && origin > 0.0 ? 1e-4 : 1e-8;
      EXPECT_NEAR(area_m2(p) / (6.0 * scale * scale), 1.0, digits) << scale << " " << origin;
      EXPECT_NEAR(normal(p).y, -1.0, digits);
      EXPECT_LT(glm::length(centroid(p) - (o + scale * Vec3(1.5, 0, 1))), digits * scale);
      EXPECT_NEAR(plane_of(p).signed_distance(p[2]), 0.0, 1e-9 * (1.0 + origin));
    }
  }
}

TEST(Polygon, CentroidOfATriangleIsTheMeanOfItsVertices) {
  const Polygon p{{0, 0, 1}, {6, 0, 1}, {0, 3, 1}};
  EXPECT_LT(glm::length(centroid(p) - Vec3(2, 1, 1)), 1e-12);
}

TEST(Polygon, DegenerateHasNoNormal) {
  EXPECT_EQ(normal({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}), Vec3(0.0));
  EXPECT_EQ(normal({{5, 5, 5}, {5, 5, 5}, {5, 5, 5}}), Vec3(0.0));
  EXPECT_EQ(normal({}), Vec3(0.0));
}

TEST(Polygon, SplitKeepsAreaAndFacing) {
  Random random(7);
  for (int i = 0; i < 500; ++i) {
    const Polygon p =
        regular(3 + static_cast<int>(random.below(6)), {1, 2, 3}, 2.0, random.uniform());
    const double a = 6.3 * random.uniform();
    const Vec3 n(std::cos(a), std::sin(a), 0.0);
    const Plane plane{n, glm::dot(n, Vec3(1, 2, 3)) + 3.0 * (random.uniform() - 0.5)};
    const auto [front, behind] = split(p, plane, 1e-9);
    EXPECT_NEAR(area_m2(front) + area_m2(behind), area_m2(p), 1e-9);
    for (const Vec3& v : front) EXPECT_GE(plane.signed_distance(v), -2e-9);
    for (const Vec3& v : behind) EXPECT_LE(plane.signed_distance(v), 2e-9);
    if (!front.empty()) {
      EXPECT_GT(area_vector(front).z, 0.0);
    }
    if (!behind.empty()) {
      EXPECT_GT(area_vector(behind).z, 0.0);
    }
  }
}

TEST(Polygon, SplitMakesNoSliverWithinTolerance) {
  const auto [front, behind] = split(square(0, 0, 1, 1), {{1, 0, 0}, 1.0 - 1e-7}, 1e-6);
  EXPECT_TRUE(front.empty());
  EXPECT_EQ(behind.size(), 4u);
}

TEST(Polygon, PolygonInThePlaneIsInFront) {
  const auto [front, behind] = split(square(0, 0, 1, 1), {{0, 0, 1}, 0.0}, 1e-6);
  EXPECT_EQ(front.size(), 4u);
  EXPECT_TRUE(behind.empty());
}

TEST(Polygon, SubtractFrameAroundAHole) {
  const auto left = subtract_coplanar(square(0, 0, 4, 3), square(1, 1, 2, 2), 1e-9);
  EXPECT_NEAR(total_area(left), 11.0, 1e-12);
  EXPECT_LE(left.size(), 4u);
}

TEST(Polygon, SubtractEverythingNothingAndTouching) {
  EXPECT_TRUE(subtract_coplanar(square(0, 0, 1, 1), square(-1, -1, 2, 2), 1e-9).empty());
  EXPECT_TRUE(subtract_coplanar(square(0, 0, 1, 1), square(0, 0, 1, 1), 1e-9).empty());
  const auto disjoint = subtract_coplanar(square(0, 0, 1, 1), square(3, 0.2, 4, 0.7), 1e-9);
  ASSERT_EQ(disjoint.size(), 1u);
  EXPECT_EQ(disjoint[0], square(0, 0, 1, 1));
  EXPECT_EQ(subtract_coplanar(square(0, 0, 1, 1), square(1, 0, 2, 1), 1e-9).size(), 1u);
}

TEST(Polygon, SubtractDoesNotMindWhichWayTheOtherFaces) {
  Polygon b = square(1, 1, 2, 2);
  std::reverse(b.begin(), b.end());
  EXPECT_NEAR(total_area(subtract_coplanar(square(0, 0, 4, 3), b, 1e-9)), 11.0, 1e-12);
}

TEST(Polygon, DifferenceAndIntersectionAddUp) {
  Random random(11);
  for (int i = 0; i < 1000; ++i) {
    const Polygon a =
        regular(3 + static_cast<int>(random.below(5)), {0, 0, 1}, 1.0, random.uniform());
    const Vec3 c(3.0 * random.uniform() - 1.5, 3.0 * random.uniform() - 1.5, 1.0);
    const Polygon b =
        regular(3 + static_cast<int>(random.below(5)), c, 0.2 + random.uniform(), random.uniform());
    const double common = area_m2(intersect_coplanar(a, b, 1e-9));
    EXPECT_NEAR(total_area(subtract_coplanar(a, b, 1e-9)) + common, area_m2(a), 1e-7);
    EXPECT_NEAR(area_m2(intersect_coplanar(b, a, 1e-9)), common, 1e-7);
  }
}

}  // namespace
}  // namespace enfilade
