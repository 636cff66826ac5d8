#include "occluders/unreachable_polygons.hpp"

#include <gtest/gtest.h>

#include "unit/gather/box_room.hpp"

namespace enfilade {
namespace {

std::vector<char> unreachable_in(const Scene& scene) {
  const std::vector<Cluster> clusters = testing::clusters_of(scene);
  const Occluders occluders(clusters);
  WorkCount work;
  return unreachable_polygons(scene, clusters, occluders, work);
}

/// A lit room with a hollow box in it: six walls outside, six inside; `gap_m` is left below its
/// lid.
Scene room_with_hollow_box(double gap_m) {
  Scene scene = testing::box_room({0, 0, 0}, {4, 5, 3}, {0.6}, {0.0});
  scene.surfaces[1].exitance = {1.0};
  testing::add_block(scene, {1, 1, 1}, {2, 2, 2 - gap_m}, {0.6}, {0.0});
  scene.surfaces[6 + 1].vertices = {{1, 1, 2}, {2, 1, 2}, {2, 2, 2}, {1, 2, 2}};  // the lid
  Scene inside = testing::box_room({1.001, 1.001, 1.001}, {1.999, 1.999, 2.0 - 1e-4}, {0.6}, {0.0});
  for (std::size_t i = 2; i < 6; ++i) {
    for (Vec3& v : inside.surfaces[i].vertices) v.z = std::min(v.z, 2.0 - gap_m);
  }
  scene.surfaces.insert(scene.surfaces.end(), inside.surfaces.begin(), inside.surfaces.end());
  return scene;
}

TEST(UnreachablePolygons, OnlyTheInsideOfAClosedBoxIsUnreachable) {
  const std::vector<char> found = unreachable_in(room_with_hollow_box(0.0));
  for (std::size_t k = 0; k < found.size(); ++k) EXPECT_EQ(found[k], k >= 12 ? 1 : 0) << k;
}

TEST(UnreachablePolygons, TheInsideOfABoxWithAGapIsReachable) {
  for (const char d : unreachable_in(room_with_hollow_box(0.1))) EXPECT_EQ(d, 0);
}

/// The emitter is so small and far that no random ray from either polygon hits the other.
TEST(UnreachablePolygons, APolygonThatSeesASmallFarEmitterIsReachable) {
  Scene scene = testing::box_room({0, 0, 0}, {1, 1, 1}, {0.0}, {0.0});
  scene.surfaces.resize(2);
  for (Vec3& v : scene.surfaces[1].vertices) v = Vec3(0.001 * v.x, 0.001 * v.y, 300.0);
  scene.surfaces[1].exitance = {1.0};
  const std::vector<char> found = unreachable_in(scene);
  EXPECT_EQ(found[0], 0);
  EXPECT_EQ(found[1], 0) << "an emitter is never unreachable";
}

TEST(UnreachablePolygons, APointLightReachesItsRoomOnly) {
  Scene scene = testing::box_room({0, 0, 0}, {4, 5, 3}, {0.5}, {0.0});
  const Scene other = testing::box_room({10, 0, 0}, {14, 5, 3}, {0.5}, {0.0});
  scene.surfaces.insert(scene.surfaces.end(), other.surfaces.begin(), other.surfaces.end());
  scene.lights.push_back({{2, 2, 2}, {100.0}});
  const std::vector<char> found = unreachable_in(scene);
  for (std::size_t k = 0; k < found.size(); ++k) EXPECT_EQ(found[k], k >= 6 ? 1 : 0) << k;
}

}  // namespace
}  // namespace enfilade
