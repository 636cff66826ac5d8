#include "geometry/sampling.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace enfilade {
namespace {

TEST(CosineDirection, MeanCosineIsTwoThirds) {
  Random random(1);
  for (const Vec3& n : {Vec3(0, 0, 1), Vec3(-1, 0, 0), glm::normalize(Vec3(1, -2, 0.5))}) {
    double sum = 0.0;
    Vec3 mean(0.0);
    constexpr int count = 20000;
    for (int i = 0; i < count; ++i) {
      const double r2 = random.uniform(), turn = random.uniform();
      const Vec3 d = cosine_direction(n, r2, turn);
      EXPECT_NEAR(glm::length(d), 1.0, 1e-12);
      EXPECT_GE(glm::dot(d, n), 0.0);
      sum += glm::dot(d, n);
      mean += d / static_cast<double>(count);
    }
    EXPECT_NEAR(sum / count, 2.0 / 3.0, 0.01);
    EXPECT_LT(glm::length(mean - 2.0 / 3.0 * n), 0.02);
  }
}

TEST(SphereDirection, IsOfUnitLengthAtTheHeightAskedFor) {
  for (const double z : {-1.0, -0.3, 0.0, 0.9, 1.0}) {
    const Vec3 d = sphere_direction(z, 0.25);
    EXPECT_NEAR(glm::length(d), 1.0, 1e-12);
    EXPECT_EQ(d.z, z);
    EXPECT_NEAR(d.x, 0.0, 1e-12);
    EXPECT_GE(d.y, 0.0);
  }
}

TEST(PointInTriangle, MeanIsTheCentroidAndAllPointsAreInside) {
  const Polygon p{{0, 0, 0}, {3, 0, 0}, {0, 6, 0}};
  Random random(2);
  Vec3 mean(0.0);
  constexpr int count = 20000;
  for (int i = 0; i < count; ++i) {
    const double r1 = random.uniform(), r2 = random.uniform();
    const Vec3 q = point_in_triangle(p[0], p[1], p[2], r1, r2);
    EXPECT_TRUE(contains_within(p, {0, 0, 1}, q, 1e-12));
    mean += q / static_cast<double>(count);
  }
  EXPECT_LT(glm::length(mean - Vec3(1, 2, 0)), 0.05);
}

TEST(RandomPoint, FallsInEveryTriangleOfTheFanEquallyOften) {
  const Polygon p{{0, 0, 0}, {1, 0, 0}, {1, 0.1, 0}, {0, 4, 0}};
  Random random(4);
  int first = 0;
  constexpr int count = 10000;
  for (int i = 0; i < count; ++i) {
    const Vec3 q = random_point(p, random);
    EXPECT_TRUE(contains_within(p, {0, 0, 1}, q, 1e-12));
    first += q.y < 0.1 * q.x;
  }
  EXPECT_NEAR(first / static_cast<double>(count), 0.5, 0.02);
}

TEST(UniformPoint, MeanIsTheCentroidOfTheArea) {
  const std::vector<Vec2> p{{0, 0}, {4, 0}, {4, 1}, {1, 3}, {0, 3}};
  double area = 0.0;
  Vec2 centre(0.0);
  for (std::size_t i = 2; i < p.size(); ++i) {
    const double a = 0.5 * cross2(p[i - 1] - p[0], p[i] - p[0]);
    area += a;
    centre += a / 3.0 * (p[0] + p[i - 1] + p[i]);
  }
  Random random(8);
  Vec2 mean(0.0);
  constexpr int count = 20000;
  for (int i = 0; i < count; ++i) {
    const double r1 = (i + random.uniform()) / count, r2 = random.uniform();
    const Vec2 q = uniform_point(p, area, r1, r2);
    EXPECT_TRUE(contains(p, q + 1e-12 * (centre / area - q)));
    mean += q / static_cast<double>(count);
  }
  EXPECT_LT(glm::length(mean - centre / area), 0.02);
}

}  // namespace
}  // namespace enfilade
