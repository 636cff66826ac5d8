#include "geometry/polygon.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/random.hpp"

namespace enfilade {
namespace {

Polygon flat_square(double x0, double y0, double x1, double y1, double z = 0.0) {
  return {{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}};
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

TEST(Polygon, TotalAreaAddsUp) {
  EXPECT_EQ(total_area_m2(std::vector<Polygon>{}), 0.0);
  EXPECT_NEAR(total_area_m2(std::vector<Polygon>{flat_square(0, 0, 1, 2), flat_square(5, 5, 8, 6)}),
              5.0, 1e-12);
}

TEST(EdgePlanes, LookOutwardAndLeaveOutShortEdges) {
  Polygon p = flat_square(0, 0, 2, 1);
  p.insert(p.begin() + 1, {2.0 - 1e-9, 0, 0});
  EXPECT_EQ(edge_planes(p, {0, 0, 1}, 0.0).size(), 5u);
  const std::vector<Plane> planes = edge_planes(p, {0, 0, 1}, 1e-6);
  ASSERT_EQ(planes.size(), 4u);
  for (const Plane& plane : planes) {
    EXPECT_LT(plane.signed_distance({1, 0.5, 0}), -0.4);
    EXPECT_EQ(plane.n.z, 0.0);
  }
}

TEST(Contains, CountsEdgesAndCornersAsInside) {
  const Polygon p = flat_square(0, 0, 2, 1, 3.0);
  for (const Vec3& inside : {Vec3(1, 0.5, 3), Vec3(2, 0.5, 3), Vec3(0, 0, 3)}) {
    EXPECT_TRUE(contains(p, {0, 0, 5}, inside));
    EXPECT_TRUE(contains_within(p, {0, 0, 1}, inside, 0.0));
  }
  const Vec3 beside(2.1, 0.5, 3);
  EXPECT_FALSE(contains(p, {0, 0, 5}, beside));
  EXPECT_FALSE(contains_within(p, {0, 0, 1}, beside, 0.0));
  EXPECT_FALSE(contains_within(p, {0, 0, 1}, beside, 0.09));
  EXPECT_TRUE(contains_within(p, {0, 0, 1}, beside, 0.11));
}

TEST(Contains, WorksInThePlaneAsInSpace) {
  const std::vector<Vec2> p{{0, 0}, {2, 0}, {2, 1}};
  EXPECT_TRUE(contains(p, {1.5, 0.5}));
  EXPECT_TRUE(contains(p, {1.0, 0.5}));
  EXPECT_FALSE(contains(p, {0.9, 0.5}));
}

TEST(Distances, ReachFromThePlaneToBothSides) {
  const Plane plane{{1, 0, 0}, 1.0};
  const DistanceRange both = distances(flat_square(0, 0, 4, 1), plane);
  EXPECT_EQ(both.lowest, -1.0);
  EXPECT_EQ(both.highest, 3.0);
  EXPECT_EQ(both.sum, 4.0);
  const DistanceRange front = distances(flat_square(2, 0, 4, 1), plane);
  EXPECT_EQ(front.lowest, 0.0);
  EXPECT_EQ(front.highest, 3.0);
  EXPECT_TRUE(lies_in(flat_square(0, 0, 1, 1), {{0, 0, 1}, 0.5}, 0.5));
  EXPECT_FALSE(lies_in(flat_square(0, 0, 1, 1), plane, 0.5));
}

TEST(Distances, OfABoxAreThoseOfItsFarthestCorner) {
  const Box box{Vec3(-1, 0, 2), Vec3(3, 1, 4)};
  Random random(3);
  for (int i = 0; i < 50; ++i) {
    const Vec3 n = glm::normalize(Vec3(random.uniform(), random.uniform(), random.uniform()) - 0.5);
    const Plane plane{n, random.uniform()};
    double highest = -1e30;
    for (const Vec3& c : box.corners()) highest = std::max(highest, plane.signed_distance(c));
    EXPECT_NEAR(highest_distance(box, plane), highest, 1e-12);
    EXPECT_EQ(plane.flipped().signed_distance(box.lo), -plane.signed_distance(box.lo));
  }
}

TEST(Polygon, OfManyCornersHoldsWhatLiesLeftOfAllItsEdges) {
  Polygon disc;
  for (int i = 0; i < 300; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 300;
    disc.push_back({std::cos(angle), 2.0 * std::sin(angle), 1.0});
  }
  Random random(5);
  int inside = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 p(2.4 * random.uniform() - 1.2, 4.8 * random.uniform() - 2.4, 1.0);
    bool left_of_all = true;
    for (std::size_t k = 0; k < disc.size(); ++k) {
      const Vec3 &a = disc[k], &b = disc[(k + 1) % disc.size()];
      left_of_all &= glm::cross(b - a, p - a).z >= 0.0;
    }
    EXPECT_EQ(contains(disc, {0, 0, 3}, p), left_of_all) << p.x << " " << p.y;
    inside += left_of_all ? 1 : 0;
  }
  EXPECT_NEAR(inside / 20000.0, std::numbers::pi / 5.76, 0.02);
  EXPECT_TRUE(contains(disc, {0, 0, 1}, disc[0]));
  EXPECT_FALSE(contains(disc, {0, 0, 1}, disc[0] + Vec3(1e-4, 0, 0)));
}

}  // namespace
}  // namespace enfilade
