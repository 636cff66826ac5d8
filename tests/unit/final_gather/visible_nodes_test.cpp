#include "final_gather/visible_nodes.hpp"

#include <gtest/gtest.h>

#include "base/random.hpp"
#include "geometry/form_factor.hpp"
#include "geometry/sampling.hpp"
#include "unit/gather/box_room.hpp"

namespace enfilade {
namespace {

/// A lamp near a corner, so that the walls beside it are bright in one place; and a screen.
testing::Solved lit_corner() {
  Scene scene = testing::box_room({0, 0, 0}, {4, 4, 3}, {0.6}, {0.0});
  Surface lamp;
  lamp.vertices = {{0.1, 0.1, 2.9}, {0.1, 0.3, 2.9}, {0.3, 0.3, 2.9}, {0.3, 0.1, 2.9}};
  lamp.reflectance = {0.0};
  lamp.exitance = {500.0};
  scene.surfaces.push_back(lamp);
  Surface screen;
  screen.vertices = {{2, 1, 0}, {2, 3, 0}, {2, 3, 1.5}, {2, 1, 1.5}};
  screen.reflectance = {0.5};
  scene.surfaces.push_back(screen);
  for (Surface& s : scene.surfaces) s.exitance.resize(1, 0.0);
  return testing::Solved(scene, Basis::linear, 1e-3);
}
constexpr std::uint32_t wall = 2;  // x = 0
const Vec3 point(3.5, 0.5, 0), up(0, 0, 1);

double sum(const std::vector<VisibleNode>& nodes) {
  double factor = 0.0;
  for (const VisibleNode& node : nodes) factor += node.factor;
  return factor;
}

TEST(VisibleNodes, AreAsFineAsTheLightVaries) {
  const testing::Solved solved = lit_corner();
  const PatchForest& forest = solved.states[wall].patches();
  VisibleNodes visible(solved.occluders);
  std::vector<VisibleNode> whole, some, all;
  ASSERT_TRUE(
      visible.find(point, up, RayScene::no_polygon, ClusterId(wall), forest, 0, 1e9, whole));
  ASSERT_TRUE(
      visible.find(point, up, RayScene::no_polygon, ClusterId(wall), forest, 0, 1e-2, some));
  ASSERT_TRUE(visible.find(point, up, RayScene::no_polygon, ClusterId(wall), forest, 0, 0.0, all));
  EXPECT_EQ(whole.size(), 1u);
  EXPECT_GT(some.size(), 1u);
  EXPECT_GT(all.size(), some.size());
  // The visible factor does not depend on the nodes; the screen hides a part of the wall.
  EXPECT_NEAR(sum(some), sum(whole), 1e-9);
  EXPECT_NEAR(sum(all), sum(whole), 1e-9);
  const double bare = point_to_polygon(point, up, solved.clusters[wall].polygons[0].polygon);
  EXPECT_LT(sum(whole), 0.9 * bare);
  EXPECT_GT(sum(whole), 0.1 * bare);
}

/// Light that rises along a wall half hidden by a screen, against many rays to the wall.
TEST(VisibleNodes, HaveTheFirstMomentOfTheirFactor) {
  testing::Solved solved = lit_corner();
  PatchForest& forest = solved.states[wall].patches();
  const double slope = 2.0;
  for (std::size_t i = 0; i < forest.size(); ++i) {
    const Vec3 centre = forest.frames()[0].at(forest.node(i).shape.centroid);
    std::span<double> light = forest.radiosity(i);
    light[0] = 1.0 + slope * centre.z;
    light[1] = slope * forest.frames()[0].u.z;
    light[2] = slope * forest.frames()[0].v.z;
  }
  VisibleNodes visible(solved.occluders);
  for (const Vec3& p : {point, Vec3(0.05, 1, 0), Vec3(1.5, 3.9, 0)}) {
    std::vector<VisibleNode> nodes;
    ASSERT_TRUE(visible.find(p, up, RayScene::no_polygon, ClusterId(wall), forest, 0, 5e-3, nodes));
    double brings = 0.0, light = 0.0;
    int open = 0;
    for (const VisibleNode& node : nodes) brings += node.irradiance(forest, 0);
    // Directions, each of them as much of the hemisphere's projection.
    constexpr int side = 1000;
    for (int i = 0; i < side * side; ++i) {
      const Vec3 d = cosine_direction(up, (i / side + 0.5) / side, (i % side + 0.5) / side);
      if (d.x >= 0.0) continue;
      const Vec3 y = p - p.x / d.x * d;
      if (y.y < 0.0 || y.y > 4.0 || y.z < 0.0 || y.z > 3.0) continue;
      if (solved.occluders.rays().occluded(p, y, RayScene::no_polygon,
                                           solved.occluders.global(ClusterId(wall), 0)))
        continue;
      light += 1.0 + slope * y.z;
      ++open;
    }
    EXPECT_NEAR(sum(nodes), open / double{side * side}, 5e-3 * sum(nodes)) << p.x;
    EXPECT_NEAR(brings / sum(nodes), light / open, 1e-3 * light / open) << p.x;
  }
}

TEST(VisibleNodes, CoverThePolygon) {
  const testing::Solved solved = lit_corner();
  const PatchForest& forest = solved.states[wall].patches();
  VisibleNodes visible(solved.occluders);
  std::vector<VisibleNode> nodes;
  ASSERT_TRUE(
      visible.find(point, up, RayScene::no_polygon, ClusterId(wall), forest, 0, 1e-2, nodes));
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const Vec3 y(0, 4.0 * random.uniform(), 3.0 * random.uniform());
    const VisibleNode* around = node_around(nodes, forest, 0, y);
    ASSERT_NE(around, nullptr);
    const Vec2 q = forest.frames()[0].project(y) - forest.node(around->node).shape.centroid;
    double reach = 0.0;
    for (const Vec2& v : forest.node(around->node).shape.vertices) {
      reach = std::max(reach, glm::length(v - forest.node(around->node).shape.centroid));
    }
    EXPECT_LE(glm::length(q), reach + 1e-9);
  }
}

}  // namespace
}  // namespace enfilade
