// What a point's gather knows of its own error.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "final_gather/emitter_sampler.hpp"
#include "final_gather/mean_light.hpp"
#include "final_gather/point_gather.hpp"
#include "geometry/sampling.hpp"
#include "unit/gather/box_room.hpp"

namespace enfilade {
namespace {

/// So many wires before a lamp that even its smallest parts have more before them than are cut out.
TEST(EmitterSampler, PartsThatAreSampledAddTheirVariance) {
  constexpr int wires = 900;
  Scene scene = testing::box_room({0, 0, 0}, {4, 4, 3}, {0.0}, {0.0});
  const auto add = [&scene](Polygon corners, double exitance) {
    Surface surface;
    surface.vertices = std::move(corners);
    surface.reflectance = {0.0};
    surface.exitance = {exitance};
    scene.surfaces.push_back(surface);
  };
  add({{1, 1, 2.9}, {1, 2, 2.9}, {2, 2, 2.9}, {2, 1, 2.9}}, 500.0);
  for (int i = 0; i < wires; ++i) {
    const double x = 1.0 + (i + 0.5) / wires, half = 0.25 / wires;
    add({{x - half, 0.5, 2.5}, {x + half, 0.5, 2.5}, {x + half, 2.5, 2.5}, {x - half, 2.5, 2.5}},
        0.0);
  }
  const std::vector<Cluster> clusters = testing::clusters_of(scene);
  const Occluders occluders(clusters);
  std::vector<ClusterState> states;
  for (const Cluster& cluster : clusters) states.emplace_back(cluster, scene, Basis::linear);
  const EmitterSampler sampler(states, occluders);
  const Vec3 p(1.6, 1.4, 0.3), up(0, 0, 1);
  double sum = 0.0, square = 0.0, told = 0.0;
  constexpr int trials = 24;
  for (std::uint64_t seed = 1; seed <= trials; ++seed) {
    Spectrum irradiance{0.0}, variance{0.0};
    Random random(seed);
    sampler.add_control_variate(p, up, RayScene::no_polygon, {}, 64, 1e-3, random, irradiance,
                                variance);
    sum += irradiance[0] / trials;
    square += irradiance[0] * irradiance[0] / trials;
    told += variance[0] / trials;
  }
  const double found = (square - sum * sum) * trials / (trials - 1.0);
  EXPECT_GT(found, 0.0);
  EXPECT_GT(told, 0.3 * found);
  EXPECT_LT(told, 4.0 * found);
}

/// The error of the patches that reflected light comes from is part of a point's error.
TEST(PointGather, TellsTheErrorOfReflectedLight) {
  Scene scene = testing::box_room({0, 0, 0}, {4, 4, 3}, {0.5}, {0.0});
  scene.surfaces[1].exitance = {10.0};
  const testing::Solved solved(scene, Basis::linear, 1e-2);
  const Vec3 p(1.3, 2.1, 0.8), n(0, 0, 1);
  const auto at = [&](double reflected_error) {
    return PointGather(solved.states, {}, solved.occluders,
                       {.rays = 256, .noise = 0.0, .reflected_error = reflected_error})
        .at(p, n);
  };
  const PointIrradiance without = at(0.0), with = at(0.1);
  const double reflected = with.irradiance[0] - with.direct[0];
  ASSERT_GT(reflected, 0.1 * with.irradiance[0]);
  EXPECT_EQ(with.irradiance[0], without.irradiance[0]);
  EXPECT_EQ(with.noise[0], without.noise[0]);
  EXPECT_DOUBLE_EQ(without.error[0], without.noise[0]);
  EXPECT_GE(with.error[0], 0.1 * reflected);
  EXPECT_LT(with.error[0], 0.2 * with.irradiance[0] + with.noise[0]);
}

/// Beyond a wall with a door, light comes over few links, which are no finer than those that bring
/// much more elsewhere. A point there tells more error relative to its light, up to what plain rays
/// show of the links' errors; one in the lit part tells what is measured all over.
TEST(PointGather, TellsMoreErrorWhereItSeesLessCertainLight) {
  Scene scene = testing::box_room({0, 0, 0}, {8, 4, 3}, {0.5}, {0.0});
  const auto add = [&](const Polygon& corners, double exitance) {
    Surface surface;
    surface.vertices = corners;
    surface.reflectance = {0.5};
    surface.exitance = {exitance};
    scene.surfaces.push_back(surface);
  };
  add({{1.8, 1.8, 2.9}, {1.8, 2.2, 2.9}, {2.2, 2.2, 2.9}, {2.2, 1.8, 2.9}}, 100.0);
  for (const bool front : {true, false}) {
    Polygon wall{{4, 0.3, 0}, {4, 4, 0}, {4, 4, 3}, {4, 0.3, 3}};
    if (!front) std::reverse(wall.begin(), wall.end());
    add(wall, 0.0);
  }
  const testing::Solved solved(scene, Basis::linear, 1e-3);
  const double reflected_error = 0.01;
  const PointGather gather(solved.states, {}, solved.occluders,
                           {.rays = 1024, .noise = 0.0, .reflected_error = reflected_error});
  const auto told = [&](const Vec3& p) {
    const PointIrradiance light = gather.at(p, {0, 0, 1});
    const double mean = mean_irradiance_over(solved.states)[0];
    const double bias =
        std::sqrt(light.error[0] * light.error[0] - light.noise[0] * light.noise[0]);
    return (bias / reflected_error - 0.1 * mean) / (light.irradiance[0] - light.direct[0]);
  };
  // The share of the links' errors in the light that rays from p read.
  const auto share = [&](const Vec3& p) {
    Random random(5);
    double light = 0.0, uncertain = 0.0;
    for (int i = 0; i < 20000; ++i) {
      const double r2 = random.uniform(), turn = random.uniform();
      const Vec3 d = cosine_direction({0, 0, 1}, r2, turn);
      const RayHit hit = solved.occluders.rays().closest(p, d);
      const PolygonRef ref = solved.occluders.local(hit.polygon);
      const PatchForest& patches = solved.states[ref.cluster.index()].patches();
      const std::size_t leaf = patches.leaf_at(ref.polygon, p + hit.distance_m * d);
      const double sent = patches.radiosity(leaf)[0] - patches.frames()[ref.polygon].exitance[0];
      light += sent;
      uncertain += sent * patches.link_error(leaf);
    }
    return uncertain / light;
  };
  const Vec3 lit(2.0, 2.0, 0.8), dark(6.0, 2.5, 0.8);
  const double all_over = mean_link_error_over(solved.states);
  ASSERT_LT(share(lit), 1.5 * all_over);
  EXPECT_GE(told(lit), 1.0 - 1e-9);
  EXPECT_LE(told(lit), 1.5);
  // Paths go on from patches that are large for their distance, to others that are surer.
  ASSERT_GT(share(dark), 3.0 * all_over);
  EXPECT_GE(told(dark), 1.5);
  EXPECT_LE(told(dark), 1.1 * share(dark) / all_over);
}

}  // namespace
}  // namespace enfilade
