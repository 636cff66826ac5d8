#include "raycast/ray_scene.hpp"

#include <gtest/gtest.h>

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

TEST(RayScene, AnEmptySceneBlocksNothing) {
  const RayScene scene(std::vector<Polygon>{});
  EXPECT_FALSE(scene.occluded({0, 0, 0}, {1, 1, 1}));
  EXPECT_FALSE(scene.closest({0, 0, 0}, {1, 1, 1}).any());
}

}  // namespace
}  // namespace enfilade
