// What a point's gather knows of its own error.
#include <gtest/gtest.h>

#include <cmath>

#include "final_gather/emitter_sampler.hpp"
#include "final_gather/point_gather.hpp"
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

}  // namespace
}  // namespace enfilade
