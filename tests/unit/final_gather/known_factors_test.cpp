// What a point sees of a polygon, part by part up to the whole gather, against the public set of
// form factors.
#include <gtest/gtest.h>

#include "final_gather/emitter_sampler.hpp"
#include "final_gather/point_gather.hpp"
#include "unit/known_factors.hpp"

namespace enfilade {
namespace {

constexpr std::uint32_t on_no_polygon = RayScene::no_polygon;
constexpr double exactly = 1e-9;

struct KnownScene {
  Scene scene;
  std::vector<Cluster> clusters;
  Occluders occluders;
  std::vector<ClusterState> states;

  explicit KnownScene(const testing::KnownFactor& known)
      : scene(testing::scene_of(known)),
        clusters(testing::clusters_of(scene)),
        occluders(clusters) {
    for (const Cluster& cluster : clusters) states.emplace_back(cluster, scene, Basis::linear);
  }
  PatchForest& shooter() { return states[0].patches(); }
};

double sum(const std::vector<VisibleNode>& nodes) {
  double factor = 0.0;
  for (const VisibleNode& node : nodes) factor += node.factor;
  return factor;
}

TEST(VisibleNodes, HaveTheKnownFactorsWhereFewStandBetween) {
  int found = 0, given_up = 0;
  for (const testing::KnownFactor& known : testing::known_factors()) {
    if (!known.from_point()) continue;
    KnownScene scene(known);
    VisibleNodes visible(scene.occluders);
    std::vector<VisibleNode> nodes;
    if (!visible.find(known.x, known.n, on_no_polygon, ClusterId(0u), scene.shooter(), 0, 1e-6,
                      nodes)) {
      ++given_up;
      continue;
    }
    ++found;
    EXPECT_NEAR(sum(nodes), known.factor, exactly) << known.name;
  }
  EXPECT_GE(found, 20);
  EXPECT_GE(given_up, 2);  // those are for find_by_parts
}

/// Light that rises along the shooter: its irradiance is the factor's first moment.
TEST(VisibleNodes, HaveTheKnownMoments) {
  for (const testing::KnownFactor& known : testing::known_factors()) {
    if (!known.from_point() || known.factor <= 0.0) continue;
    KnownScene scene(known);
    PatchForest& forest = scene.shooter();
    const PolygonFrame& frame = forest.frames()[0];
    const Vec3 gradient = 0.3 * frame.u - 0.7 * frame.v;
    const std::span<double> light = forest.radiosity(0);
    light[0] = 1.0 + glm::dot(gradient, frame.at(forest.node(0).shape.centroid) - known.shooter[0]);
    light[1] = 0.3;
    light[2] = -0.7;
    const double want = known.factor + glm::dot(gradient, known.moment);
    VisibleNodes visible(scene.occluders);
    std::vector<VisibleNode> nodes;
    double brings = 0.0;
    if (visible.find(known.x, known.n, on_no_polygon, ClusterId(0u), forest, 0, 1e-5, nodes)) {
      for (const VisibleNode& node : nodes) brings += node.irradiance(forest, 0);
    } else {
      VisibleNode node{0};
      Random random(1);
      visible.find_by_parts(known.x, known.n, on_no_polygon, ClusterId(0u), forest, 0, 1e-5, 0.0,
                            random, node);
      brings = node.irradiance(forest, 0);
    }
    EXPECT_NEAR(brings, want, 2e-4 * known.factor) << known.name;
  }
}

/// Cut as often as it may be, a polygon behind any number of occluders is exact but for what the
/// smallest parts' rays leave open.
TEST(VisibleNodes, FindTheKnownFactorsByParts) {
  int exact = 0, points = 0;
  for (const testing::KnownFactor& known : testing::known_factors()) {
    if (!known.from_point()) continue;
    KnownScene scene(known);
    VisibleNodes visible(scene.occluders);
    VisibleNode node{0};
    Random random(2);
    const double variance = visible.find_by_parts(known.x, known.n, on_no_polygon, ClusterId(0u),
                                                  scene.shooter(), 0, 1e-6, 1e-5, random, node);
    EXPECT_NEAR(node.factor, known.factor, exactly + 4.0 * std::sqrt(variance)) << known.name;
    EXPECT_LE(std::sqrt(variance), 0.01 * known.factor + 1e-4) << known.name;
    ++points;
    exact += variance == 0.0 ? 1 : 0;
  }
  EXPECT_GE(exact, points * 2 / 3);
}

TEST(EmitterSampler, IntegratesTheKnownFactors) {
  for (const testing::KnownFactor& known : testing::known_factors()) {
    if (!known.from_point()) continue;
    const KnownScene scene(known);
    const EmitterSampler sampler(scene.states, scene.occluders);
    Spectrum irradiance{0.0}, variance{0.0};
    Random random(3);
    const EmitterSampler::ControlVariate control =
        sampler.add_control_variate(known.x, known.n, on_no_polygon,
                                    sampler.survey(known.x, known.n, on_no_polygon, 256, random), 1,
                                    1e-4, random, irradiance, variance);
    if (control.polygons.empty()) {
      EXPECT_EQ(irradiance[0], control.ambient[0]) << known.name;  // left to the rays
      continue;
    }
    EXPECT_NEAR(irradiance[0], known.factor, exactly + 4.0 * std::sqrt(variance[0])) << known.name;
    Spectrum emitted{0.0};
    sampler.add_emitted(control, emitted);
    EXPECT_NEAR(emitted[0], irradiance[0], exactly) << known.name;
  }
}

TEST(PointGather, FindsTheKnownFactorsWithinItsError) {
  for (const testing::KnownFactor& known : testing::known_factors()) {
    if (!known.from_point()) continue;
    const KnownScene scene(known);
    const PointGather gather(scene.states, {}, scene.occluders, {.rays = 64, .noise = 0.0});
    const PointIrradiance light = gather.at(known.x, known.n);
    // The gather begins a little above the point.
    const double slack = 4e-4 * known.factor + 1e-8;
    EXPECT_NEAR(light.irradiance[0], known.factor, 4.0 * light.error[0] + slack) << known.name;
    EXPECT_LE(light.error[0], 0.02 * known.factor + 1e-4) << known.name;
  }
}

}  // namespace
}  // namespace enfilade
