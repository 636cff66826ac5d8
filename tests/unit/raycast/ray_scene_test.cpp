#include "raycast/ray_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.hpp"

namespace enfilade {
namespace {

/// A unit square at height z facing up.
Polygon square(double z, double size = 1.0, Vec3 offset = Vec3(0.0)) {
  Polygon p{{0, 0, z}, {size, 0, z}, {size, size, z}, {0, size, z}};
  for (Vec3& v : p) v += offset;
  return p;
}

TEST(RayScene, BlocksFromBothSides) {
  const std::vector<Polygon> polygons{square(1.0)};
  const RayScene scene(polygons);
  EXPECT_TRUE(scene.occluded({0.5, 0.5, 0.0}, {0.5, 0.5, 2.0}));
  EXPECT_TRUE(scene.occluded({0.5, 0.5, 2.0}, {0.5, 0.5, 0.0}));
  EXPECT_FALSE(scene.occluded({1.5, 0.5, 0.0}, {1.5, 0.5, 2.0}));
}

TEST(RayScene, PassesPanesAndTellsOfThem) {
  const std::vector<Polygon> polygons{square(1.0), square(2.0), square(3.0), square(1.5, 0.2)};
  const std::vector<char> panes{1, 0, 1, 1};
  const RayScene scene(polygons, panes);
  EXPECT_TRUE(scene.has_panes());
  EXPECT_FALSE(scene.occluded({0.5, 0.5, 0.5}, {0.5, 0.5, 1.8}));
  EXPECT_TRUE(scene.occluded({0.5, 0.5, 0.5}, {0.5, 0.5, 2.5}));
  const RayHit hit = scene.closest({0.5, 0.5, 0.5}, {0, 0, 1});
  EXPECT_EQ(hit.polygon, 1u);
  EXPECT_NEAR(hit.distance_m, 1.5, 1e-6);
  std::vector<PaneCrossing> found;
  constexpr std::uint32_t none = RayScene::no_polygon;
  // Along the line between the two triangles of a square, downwards and aslant.
  scene.crossings({0.5, 0.5, 4.0}, {0, 0, -2}, 100.0, none, none, RayStart::in_air, found);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].polygon, 2u);
  EXPECT_NEAR(found[0].distance_m, 1.0, 1e-6);
  EXPECT_EQ(found[1].polygon, 0u);
  EXPECT_NEAR(found[1].cosine, 1.0, 1e-12);
  scene.crossings({0.1, 0.1, 0.5}, {0.03, 0, 0.4}, 10.0, 2, none, RayStart::in_air, found);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[1].polygon, 3u);
  EXPECT_NEAR(found[1].cosine, -0.4 / std::hypot(0.03, 0.4), 1e-12);
  scene.crossings({0.1, 0.1, 0.5}, {0, 0, 1}, 0.4, none, none, RayStart::in_air, found);
  EXPECT_TRUE(found.empty());
}

TEST(RayScene, SkipsTheTwoPolygonsNamed) {
  const std::vector<Polygon> polygons{square(0.0), square(1.0), square(2.0)};
  const RayScene scene(polygons);
  const Vec3 a(0.4, 0.6, 0.0), b(0.5, 0.5, 2.0);
  EXPECT_TRUE(scene.occluded(a, b, 0, 2));
  EXPECT_FALSE(scene.occluded(a, b, 0, 1));
}

TEST(RayScene, TellsWhichSideWasHit) {
  const std::vector<Polygon> polygons{square(1.0)};
  const RayScene scene(polygons);
  const RayHit below = scene.closest({0.5, 0.5, 0.0}, {0, 0, 1});
  ASSERT_TRUE(below.any());
  EXPECT_FALSE(below.front);
  EXPECT_NEAR(below.distance_m, 1.0, 1e-6);
  const RayHit above = scene.closest({0.5, 0.5, 3.0}, {0, 0, -2});
  ASSERT_TRUE(above.any());
  EXPECT_TRUE(above.front);
  EXPECT_NEAR(above.distance_m, 2.0, 1e-6);
}

TEST(RayScene, SeesAGapOfAMillimetreFarFromTheOrigin) {
  const Vec3 far(1e6, -2e6, 3e5);
  const std::vector<Polygon> polygons{square(0.0, 1.0, far), square(0.001, 1.0, far)};
  const RayScene scene(polygons);
  EXPECT_TRUE(scene.occluded(far + Vec3(0.5, 0.5, -0.5), far + Vec3(0.5, 0.5, 0.0005)));
  EXPECT_FALSE(scene.occluded(far + Vec3(-0.5, 0.5, 0.0005), far + Vec3(1.5, 0.5, 0.0005)));
}

TEST(RayScene, ASpanOfRaysGivesTheHitsOfSingleRays) {
  Random random(5);
  std::vector<Polygon> polygons;
  for (int i = 0; i < 40; ++i) {
    const Vec3 at(random.uniform(), random.uniform(), 0.0);
    polygons.push_back(square(random.uniform(), 0.4, at));
    polygons.emplace_back(polygons.back().rbegin(), polygons.back().rend());  // back to back
  }
  const RayScene scene(polygons);
  const auto point = [&] { return Vec3(random.uniform(), random.uniform(), random.uniform()); };
  std::vector<RayScene::Ray> rays;
  std::vector<RayScene::Sight> segments;
  for (int i = 0; i < 500; ++i) {
    const auto skip = static_cast<std::uint32_t>(random.below(polygons.size()));
    const Vec3 a = point(), b = point();
    rays.push_back({a, b - a, skip, 0.5});
    segments.push_back({a, b, skip, skip + 1});
  }
  std::vector<RayHit> hits(rays.size());
  std::vector<std::uint8_t> blocked(segments.size());
  int any_hit = 0, any_blocked = 0;
  for (const RayStart start : {RayStart::on_polygon, RayStart::in_air}) {
    scene.closest(rays, hits, start);
    scene.occluded(segments, blocked, start);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const auto& [from, direction, skip, far_m] = rays[i];
      const RayHit one = scene.closest(from, direction, skip, far_m, start);
      EXPECT_EQ(hits[i].polygon, one.polygon);
      EXPECT_EQ(hits[i].distance_m, one.distance_m);
      EXPECT_EQ(hits[i].front, one.front);
      const auto& [a, b, skip_a, skip_b] = segments[i];
      EXPECT_EQ(blocked[i] != 0, scene.occluded(a, b, skip_a, skip_b, start));
      any_hit += one.any();
      any_blocked += blocked[i];
    }
  }
  EXPECT_GT(any_hit, 100);
  EXPECT_GT(any_blocked, 100);
}

TEST(RayScene, RefusesSpansOfUnequalSizes) {
  const RayScene scene(std::vector<Polygon>{square(0.0)});
  std::vector<RayHit> hits(1);
  EXPECT_THROW(scene.closest(std::vector<RayScene::Ray>(2), hits), std::logic_error);
}

/// Two polygons that meet have points in common: from a point to itself there is no direction, and
/// nothing stands between.
TEST(RayScene, NothingLiesBetweenAPointAndItself) {
  const std::vector<Polygon> polygons{square(0.0), square(1.0)};
  const std::vector<char> panes{0, 1};
  const RayScene scene(polygons, panes);
  const Vec3 p(0.5, 0.5, 1.0);
  EXPECT_FALSE(scene.closest(p, Vec3(0.0)).any());
  EXPECT_FALSE(scene.closest(p, Vec3(0.0), 1, -scene.epsilon_m()).any());
  EXPECT_FALSE(scene.occluded(p, p));
  std::vector<PaneCrossing> found{{}};
  scene.crossings(p, Vec3(0.0), 1.0, RayScene::no_polygon, RayScene::no_polygon, RayStart::in_air,
                  found);
  EXPECT_TRUE(found.empty());
}

TEST(RayScene, AnEmptySceneBlocksNothing) {
  const RayScene scene(std::vector<Polygon>{});
  EXPECT_FALSE(scene.occluded({0, 0, 0}, {1, 1, 1}));
  EXPECT_FALSE(scene.closest({0, 0, 0}, {1, 1, 1}).any());
}

}  // namespace
}  // namespace enfilade
