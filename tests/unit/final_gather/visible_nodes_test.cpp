#include "final_gather/visible_nodes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

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

double sum_of(const std::vector<VisibleNode>& nodes) {
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
  EXPECT_NEAR(sum_of(some), sum_of(whole), 1e-9);
  EXPECT_NEAR(sum_of(all), sum_of(whole), 1e-9);
  const double bare = point_to_polygon(point, up, solved.clusters[wall].polygons[0].polygon);
  EXPECT_LT(sum_of(whole), 0.9 * bare);
  EXPECT_GT(sum_of(whole), 0.1 * bare);
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
    EXPECT_NEAR(sum_of(nodes), open / double{side * side}, 5e-3 * sum_of(nodes)) << p.x;
    EXPECT_NEAR(brings / sum_of(nodes), light / open, 1e-3 * light / open) << p.x;
  }
}

/// The lamp behind thirty narrow slats, none of which hides it all, and perhaps a wall.
testing::Solved lamp_behind_slats(bool walled) {
  Scene scene = testing::box_room({0, 0, 0}, {4, 4, 3}, {0.6}, {0.0});
  const auto add = [&scene](double x, double y0, double y1, double z0, double z1) {
    Surface sheet;
    sheet.vertices = {{x, y0, z0}, {x, y1, z0}, {x, y1, z1}, {x, y0, z1}};
    sheet.reflectance = {0.5};
    sheet.exitance = {0.0};
    scene.surfaces.push_back(sheet);
  };
  add(0.2, 0.1, 0.3, 2.7, 2.9);
  scene.surfaces.back().exitance = {500.0};
  for (int i = 0; i < 30; ++i) {
    const double x = 2.2 + 0.02 * i, z = 2.8 * (3.5 - x) / 3.3;
    add(x, 0.2, 0.6, z + 0.005, z + 0.015);  // above the middle
  }
  if (walled) add(1.0, 0.01, 3.99, 0.01, 2.99);
  return testing::Solved(scene, Basis::linear, 1e-3);
}

TEST(VisibleNodes, AWallHidesAllWhateverStandsBeforeIt) {
  const Vec3 above_floor = point + 1e-3 * up;
  for (const bool walled : {false, true}) {
    const testing::Solved solved = lamp_behind_slats(walled);
    const auto lamp = std::ranges::find_if(solved.states, [](const ClusterState& state) {
      return state.patches().frames()[0].exitance[0] > 0.0;
    });
    ASSERT_NE(lamp, solved.states.end());
    const PatchForest& forest = lamp->patches();
    VisibleNodes visible(solved.occluders);
    std::vector<VisibleNode> nodes;
    // Slats alone are too many to be cut out.
    EXPECT_EQ(
        visible.find(above_floor, up, RayScene::no_polygon, lamp->id(), forest, 0, 0.0, nodes),
        walled);
    EXPECT_TRUE(nodes.empty());
    VisibleNode part;
    Random random(1);
    const double variance = visible.find_by_parts(above_floor, up, RayScene::no_polygon, lamp->id(),
                                                  forest, 0, 0.0, 1e-4, random, part);
    if (walled) {
      EXPECT_EQ(part.factor, 0.0);
      EXPECT_EQ(variance, 0.0);
    } else {
      EXPECT_GT(part.factor, 0.0);
    }
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

/// Wires before a lamp, more than are cut out of the whole lamp: the factor is that of the gaps.
TEST(VisibleNodes, FindAPolygonBehindManyOthersByParts) {
  constexpr int wires = 40;
  Scene scene = testing::box_room({0, 0, 0}, {4, 4, 3}, {0.6}, {0.0});
  Surface lamp;
  lamp.vertices = {{1, 1, 2.9}, {1, 2, 2.9}, {2, 2, 2.9}, {2, 1, 2.9}};
  lamp.reflectance = {0.0};
  lamp.exitance = {500.0};
  scene.surfaces.push_back(lamp);
  for (int i = 0; i < wires; ++i) {
    const double x = 1.0 + (i + 0.5) / wires;
    Surface wire;
    wire.vertices = {
        {x - 0.004, 0.5, 2}, {x + 0.004, 0.5, 2}, {x + 0.004, 2.5, 2}, {x - 0.004, 2.5, 2}};
    wire.reflectance = {0.0};
    scene.surfaces.push_back(wire);
  }
  for (Surface& s : scene.surfaces) s.exitance.resize(1, 0.0);
  const testing::Solved solved(scene, Basis::linear, 1e-3);
  constexpr std::uint32_t lamp_cluster = 6;
  const PatchForest& forest = solved.states[lamp_cluster].patches();
  const Vec3 p(1.6, 1.4, 0.3);
  // Seen from p, a wire hides a strip of the lamp; what is left are the gaps.
  const Polygon& whole = solved.clusters[lamp_cluster].polygons[0].polygon;
  double want = point_to_polygon(p, up, whole);
  const double stretch = (2.9 - p.z) / (2.0 - p.z);
  for (int i = 0; i < wires; ++i) {
    const double x = 1.0 + (i + 0.5) / wires;
    const double lo = std::clamp(p.x + stretch * (x - 0.004 - p.x), 1.0, 2.0);
    const double hi = std::clamp(p.x + stretch * (x + 0.004 - p.x), 1.0, 2.0);
    const Polygon hidden{{lo, 1, 2.9}, {lo, 2, 2.9}, {hi, 2, 2.9}, {hi, 1, 2.9}};
    if (hi > lo) want -= point_to_polygon(p, up, hidden);
  }
  VisibleNodes visible(solved.occluders);
  Random random(7);
  VisibleNode exact{0};
  const double none = visible.find_by_parts(p, up, RayScene::no_polygon, ClusterId(lamp_cluster),
                                            forest, 0, 1e9, 0.0, random, exact);
  EXPECT_NEAR(exact.factor, want, 1e-9);
  EXPECT_EQ(none, 0.0);
  // Sampled as a whole: unbiased (Student's t), and as noisy as it says.
  constexpr int trials = 2000;
  double sum = 0.0, square = 0.0, variance = 0.0;
  for (int i = 0; i < trials; ++i) {
    VisibleNode sampled{0};
    variance += visible.find_by_parts(p, up, RayScene::no_polygon, ClusterId(lamp_cluster), forest,
                                      0, 1e9, 1.0, random, sampled) /
                trials;
    sum += sampled.factor / trials;
    square += sampled.factor * sampled.factor / trials;
  }
  const double true_variance = square - sum * sum;
  // A ray stands for the mean factor of the lamp, which hides little variation at this distance.
  EXPECT_NEAR(sum, want, 4.0 * std::sqrt(true_variance / trials) + 5e-3 * want);
  EXPECT_GT(variance, 0.5 * true_variance);
  EXPECT_LT(variance, 4.0 * true_variance);
}

}  // namespace
}  // namespace enfilade
