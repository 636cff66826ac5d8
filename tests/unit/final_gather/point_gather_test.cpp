#include "final_gather/point_gather.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "final_gather/mean_light.hpp"
#include "unit/gather/box_room.hpp"

namespace enfilade {
namespace {

TEST(MeanLight, PathsGoOnFartherWherePatchesAreLessRight) {
  const Spectrum mean = {10.0, 20.0};
  EXPECT_EQ(darkness(mean, std::vector<double>{30.0, 40.0}), 1.0);
  EXPECT_EQ(darkness(mean, std::vector<double>{30.0, 5.0}), 4.0);
  EXPECT_GT(darkness(mean, std::vector<double>{0.0, 20.0}), 1e6);
  EXPECT_EQ(darkness({0.0}, std::vector<double>{0.0}), 1.0);
  EXPECT_EQ(far_sides(0.001), 1.0);
  EXPECT_EQ(far_sides(0.02), 2.0);
  EXPECT_EQ(far_sides(0.5), 4.0);
}

TEST(PointGatherConfig, SetsAreAsLargeAsThePatchesAreRight) {
  const auto rays = [](double patch_error) {
    return PointGatherConfig{.patch_error = patch_error}.rays_in_set();
  };
  EXPECT_EQ(rays(0.0), 4096);
  EXPECT_EQ(rays(0.01), 4096);
  EXPECT_EQ(rays(0.02), 1024);
  EXPECT_EQ(rays(0.08), 512);
  EXPECT_EQ(rays(1.0), 512);
  EXPECT_EQ((PointGatherConfig{.rays = 100, .patch_error = 0.01}.rays_in_set()), 100);
}

TEST(PointGather, DirectLightOfAPanelMatchesTheClosedForm) {
  Scene scene = testing::box_room({0, 0, 0}, {4, 4, 3}, {0.0}, {0.0});
  Surface lamp;
  lamp.vertices = {{1.5, 1.5, 2.9}, {1.5, 2.5, 2.9}, {2.5, 2.5, 2.9}, {2.5, 1.5, 2.9}};
  lamp.reflectance = {0.0};
  lamp.exitance = {10.0};
  scene.surfaces.push_back(lamp);
  const testing::Solved solved(scene, Basis::linear, 1e-3);
  const PointGather gather(solved.states, scene.lights, solved.occluders, {});
  const double x = 0.5 / 2.9,
               s = std::sqrt(1 + x * x);  // below its middle: four quarter rectangles
  const double factor = 4.0 * (2.0 * x / s * std::atan(x / s)) / (2.0 * std::numbers::pi);
  EXPECT_NEAR(gather.irradiance({2, 2, 0}, {0, 0, 1})[0], 10.0 * factor, 1e-3 * 10.0 * factor);
}

TEST(PointGather, HalfHiddenPanelGivesHalf) {
  Scene scene = testing::box_room({0, 0, 0}, {4, 4, 3}, {0.0}, {0.0});
  Surface lamp;
  lamp.vertices = {{1.5, 1.5, 2.9}, {1.5, 2.5, 2.9}, {2.5, 2.5, 2.9}, {2.5, 1.5, 2.9}};
  lamp.reflectance = {0.0};
  lamp.exitance = {10.0};
  scene.surfaces.push_back(lamp);
  Surface blind = lamp;  // hides the half x > 2 from the point below the middle
  blind.vertices = {{2.0, 1.0, 2.0}, {2.0, 3.0, 2.0}, {3.0, 3.0, 2.0}, {3.0, 1.0, 2.0}};
  blind.exitance = {0.0};
  scene.surfaces.push_back(blind);
  const testing::Solved solved(scene, Basis::linear, 1e-3);
  const PointGather gather(solved.states, scene.lights, solved.occluders, {});
  const double x = 0.5 / 2.9, s = std::sqrt(1 + x * x);
  const double factor = 2.0 * (2.0 * x / s * std::atan(x / s)) / (2.0 * std::numbers::pi);
  EXPECT_NEAR(gather.irradiance({2, 2, 0}, {0, 0, 1})[0], 10.0 * factor, 5e-3 * 10.0 * factor);
}

TEST(PointGather, PatchesAgreeWithTheGatherInAFurnace) {
  const testing::Solved solved(testing::box_room({0, 0, 0}, {4, 4, 3}, {0.6}, {0.4 * 3.0}),
                               Basis::linear, 1e-3);
  const PointGather gather(solved.states, solved.scene.lights, solved.occluders, {});
  for (const Vec3 p : {Vec3(0.01, 0.01, 0), Vec3(2, 3.9, 0), Vec3(2, 2, 0)}) {
    EXPECT_NEAR(gather.irradiance(p, {0, 0, 1})[0], 3.0, 3e-3);
    EXPECT_NEAR(gather.from_patches(p, {0, 0, 1})[0], 3.0, 1e-2);
  }
}

TEST(PointGather, AGapBelowASlabIsDarkEvenWithCoarsePatches) {
  // A slab 1 cm above the floor: nothing comes to its middle, though the floor is one bright patch.
  Scene scene = testing::box_room({0, 0, 0}, {4, 4, 3}, {0.5}, {0.0});
  scene.surfaces.back().exitance = {10.0};
  Surface slab;
  slab.reflectance = {0.5};
  slab.exitance = {0.0};
  slab.vertices = {{1, 1, 0.01}, {1, 3, 0.01}, {3, 3, 0.01}, {3, 1, 0.01}};  // faces down
  scene.surfaces.push_back(slab);
  const testing::Solved solved(scene, Basis::linear, 1.0);
  const PointGather gather(solved.states, scene.lights, solved.occluders, {});
  const double lit = gather.irradiance({0.5, 2, 0}, {0, 0, 1})[0];
  ASSERT_GT(gather.from_patches({2, 2, 0}, {0, 0, 1})[0], 0.1 * lit)
      << "the patches know no better";
  EXPECT_LT(gather.irradiance({2, 2, 0}, {0, 0, 1})[0], 1e-3 * lit);
}

TEST(PointGather, NoisyPointsGetMoreRaysAndOthersNone) {
  // Below a table the light comes round its edges, over several reflections.
  Scene scene = testing::box_room({0, 0, 0}, {4, 4, 3}, {0.5}, {0.0});
  scene.surfaces.back().exitance = {10.0};
  testing::add_block(scene, {1, 1, 0.3}, {3, 3, 0.4}, {0.5}, {0.0});
  const testing::Solved solved(scene, Basis::linear, 1e-1);
  const auto deviation = [&](const Vec3& p, double noise) {
    double sum = 0.0, square = 0.0;
    constexpr int seeds = 16;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      const PointGather gather(solved.states, scene.lights, solved.occluders,
                               {.rays = 256, .noise = noise, .seed = seed});
      const double e = gather.irradiance(p, {0, 0, 1})[0];
      sum += e;
      square += e * e;
    }
    const double mean = sum / seeds;
    return std::sqrt(square / seeds - mean * mean) / mean;
  };
  const Vec3 below(2, 2, 0);
  const double once = deviation(below, 0.0), often = deviation(below, 1e-6),
               enough = deviation(below, 10.0);
  EXPECT_GT(once, 0.01);
  EXPECT_LT(often, 0.5 * once);  // 16 times the rays: a quarter or less
  EXPECT_DOUBLE_EQ(enough, once);
}

TEST(PointGather, AsksForNoLessNoiseThanThePatchesErrorDeserves) {
  PointGatherConfig config;
  config.patch_error = 0.1;
  EXPECT_DOUBLE_EQ(config.least_noise(), 0.005);
  config.patch_error = 0.002;
  EXPECT_DOUBLE_EQ(config.least_noise(), 0.001);
  config.noise = 0.0;
  EXPECT_DOUBLE_EQ(config.least_noise(), 0.0);
}

}  // namespace
}  // namespace enfilade
