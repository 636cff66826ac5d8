#include "geometry/clip.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/random.hpp"

namespace enfilade {
namespace {

Polygon square(double x0, double y0, double x1, double y1, double z = 0.0) {
  return {{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}};
}

Polygon regular(int sides, const Vec3& center, double radius, double phase) {
  Polygon p;
  for (int i = 0; i < sides; ++i) {
    const double a = phase + 2.0 * std::numbers::pi * i / sides;
    p.push_back(center + radius * Vec3(std::cos(a), std::sin(a), 0.0));
  }
  return p;
}

TEST(Clip, SplitKeepsAreaAndFacing) {
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

TEST(Clip, SplitMakesNoSliverWithinTolerance) {
  const auto [front, behind] = split(square(0, 0, 1, 1), {{1, 0, 0}, 1.0 - 1e-7}, 1e-6);
  EXPECT_TRUE(front.empty());
  EXPECT_EQ(behind.size(), 4u);
}

TEST(Clip, PolygonInThePlaneIsInFront) {
  const auto [front, behind] = split(square(0, 0, 1, 1), {{0, 0, 1}, 0.0}, 1e-6);
  EXPECT_EQ(front.size(), 4u);
  EXPECT_TRUE(behind.empty());
}

TEST(Clip, SubtractFrameAroundAHole) {
  const auto left = subtract_coplanar(square(0, 0, 4, 3), square(1, 1, 2, 2), 1e-9);
  EXPECT_NEAR(total_area_m2(left), 11.0, 1e-12);
  EXPECT_LE(left.size(), 4u);
}

TEST(Clip, SubtractEverythingNothingAndTouching) {
  EXPECT_TRUE(subtract_coplanar(square(0, 0, 1, 1), square(-1, -1, 2, 2), 1e-9).empty());
  EXPECT_TRUE(subtract_coplanar(square(0, 0, 1, 1), square(0, 0, 1, 1), 1e-9).empty());
  const auto disjoint = subtract_coplanar(square(0, 0, 1, 1), square(3, 0.2, 4, 0.7), 1e-9);
  ASSERT_EQ(disjoint.size(), 1u);
  EXPECT_EQ(disjoint[0], square(0, 0, 1, 1));
  EXPECT_EQ(subtract_coplanar(square(0, 0, 1, 1), square(1, 0, 2, 1), 1e-9).size(), 1u);
}

TEST(Clip, SubtractDoesNotMindWhichWayTheOtherFaces) {
  Polygon b = square(1, 1, 2, 2);
  std::reverse(b.begin(), b.end());
  EXPECT_NEAR(total_area_m2(subtract_coplanar(square(0, 0, 4, 3), b, 1e-9)), 11.0, 1e-12);
}

TEST(Clip, DifferenceAndIntersectionAddUp) {
  Random random(11);
  for (int i = 0; i < 1000; ++i) {
    const Polygon a =
        regular(3 + static_cast<int>(random.below(5)), {0, 0, 1}, 1.0, random.uniform());
    const Vec3 c(3.0 * random.uniform() - 1.5, 3.0 * random.uniform() - 1.5, 1.0);
    const Polygon b =
        regular(3 + static_cast<int>(random.below(5)), c, 0.2 + random.uniform(), random.uniform());
    const double common = area_m2(intersect_coplanar(a, b, 1e-9));
    EXPECT_NEAR(total_area_m2(subtract_coplanar(a, b, 1e-9)) + common, area_m2(a), 1e-7);
    EXPECT_NEAR(area_m2(intersect_coplanar(b, a, 1e-9)), common, 1e-7);
  }
}

TEST(Clip, WhatIsLeftBesideManyEdgesLiesInSmallBoxes) {
  const Polygon whole = square(-2, -2, 2, 2), disc = regular(1000, {0, 0, 0}, 1.0, 0.1);
  const std::vector<Polygon> left = subtract_coplanar(whole, disc, 1e-9);
  EXPECT_NEAR(total_area_m2(left) + area_m2(disc), 16.0, 1e-9);
  // Slivers that all reach to the square's border would have boxes of hundreds of times its area.
  double boxes = 0.0;
  for (const Polygon& part : left) {
    const Vec3 size = bounds(part).hi - bounds(part).lo;
    boxes += size.x * size.y;
  }
  EXPECT_LT(boxes, 3.0 * 16.0);
}

TEST(Clip, KeepsTheHalvesThatSplitMakes) {
  Random random(17);
  for (int i = 0; i < 200; ++i) {
    const Polygon p = regular(3 + static_cast<int>(random.below(6)), {1, 2, 3}, 2.0, 1.0);
    const double a = 6.3 * random.uniform();
    const Vec3 n(std::cos(a), std::sin(a), 0.0);
    const Plane plane{n, glm::dot(n, Vec3(1, 2, 3)) + 3.0 * (random.uniform() - 0.5)};
    Polygon front = p, behind = p;
    clip_front(front, plane, 1e-9);
    clip_behind(behind, plane, 1e-9);
    const auto parts = split(p, plane, 1e-9);
    EXPECT_EQ(behind, parts.second);
    ASSERT_EQ(front.size(), parts.first.size());
    for (std::size_t k = 0; k < front.size(); ++k)
      EXPECT_LT(glm::length(front[k] - parts.first[k]), 1e-14);
  }
}

TEST(Clip, KeepsAPolygonInThePlaneOnEitherSide) {
  Polygon front = square(0, 0, 1, 1), behind = front;
  clip_front(front, {{0, 0, 1}, 0.0}, 1e-9);
  clip_behind(behind, {{0, 0, 1}, 0.0}, 1e-9);
  EXPECT_EQ(front.size(), 4u);
  EXPECT_EQ(behind.size(), 4u);
}

TEST(Clip, SharedEdgesAreCutInTheVerySamePoint) {
  const Plane plane{glm::normalize(Vec3(1.0, 0.37, 0.2)), 0.41};
  const Vec3 a(0.1, 0.3, 0.7), b(0.9, 0.2, 0.1);
  const auto [front, behind] = split({a, b, {0.5, 2, 0}}, plane, 1e-9);
  const auto [front2, behind2] = split({b, a, {0.5, -2, 0}}, plane, 1e-9);
  const auto holds = [](const Polygon& p, const Vec3& v) {
    return std::find(p.begin(), p.end(), v) != p.end();
  };
  int shared = 0;
  for (const Vec3& v : front) shared += holds(front2, v) && holds(behind, v) && holds(behind2, v);
  EXPECT_EQ(shared, 1);
}

TEST(Clip, ASegmentKeepsWhatLiesInFront) {
  const Plane plane{{1, 0, 0}, 1.0};
  Segment s{{0, 0, 0}, {4, 4, 0}};
  ASSERT_TRUE(clip_front(s, plane, 1e-6));
  EXPECT_EQ(s.a, Vec3(1, 1, 0));
  EXPECT_EQ(s.b, Vec3(4, 4, 0));
  ASSERT_TRUE(clip_front(s, {{-1, 0, 0}, -3.0}, 1e-6));
  EXPECT_EQ(s.b, Vec3(3, 3, 0));
  EXPECT_FALSE(clip_front(s, {{1, 0, 0}, 3.0 - 1e-7}, 1e-6));
  EXPECT_EQ(s.a, Vec3(1, 1, 0));
}

TEST(WalkCut, HalvesOfAPlanePolygonMeetInTwoCrossings) {
  const std::vector<Vec2> p{{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  std::vector<Vec2> below, above, crossings;
  walk_cut(
      p, [](const Vec2& v) { return v.x - 0.5; },
      [&](const Vec2& v, bool is_below) { (is_below ? below : above).push_back(v); },
      [&](const Vec2& v) { crossings.push_back(v); });
  EXPECT_EQ(below, (std::vector<Vec2>{{0, 0}, {0, 2}}));
  EXPECT_EQ(above, (std::vector<Vec2>{{2, 0}, {2, 2}}));
  EXPECT_EQ(crossings, (std::vector<Vec2>{{0.5, 0}, {0.5, 2}}));
}

TEST(WalkCut, ACornerOnTheLineIsAbove) {
  const std::vector<Vec2> p{{0, 0}, {2, 0}, {0, 2}};
  int below = 0, above = 0, crossings = 0;
  walk_cut(
      p, [](const Vec2& v) { return v.x; },
      [&](const Vec2&, bool is_below) { ++(is_below ? below : above); },
      [&](const Vec2&) { ++crossings; });
  EXPECT_EQ(below, 0);
  EXPECT_EQ(above, 3);
  EXPECT_EQ(crossings, 0);
}

}  // namespace
}  // namespace enfilade
