#include "gather/error_samples.hpp"

#include <gtest/gtest.h>

#include "geometry/form_factor.hpp"
#include "geometry/visible_parts.hpp"
#include "unit/gather/box_room.hpp"

namespace enfilade {
namespace {

using testing::Solved;

/// Samples cluster `of` of a solution as it is.
ErrorSampleSums sampled(Solved& solved, std::size_t of, const ErrorSampleConfig& config) {
  WorkCount work;
  ErrorSamples samples(solved.states[of], solved.occluders, config, work);
  for (const LightSource& light : solved.scene.lights) samples.add(light);
  for (const ClusterState& state : solved.states) samples.add(state);
  return samples.compare(solved.states[of]);
}

/// A black floor below a lamp of its own size, one patch: what an affine function cannot follow is
/// known in closed form.
TEST(ErrorSamples, MeasureWhatThePatchesCannotFollow) {
  Scene scene = testing::box_room({0, 0, 0}, {1, 1, 0.4}, {0.0}, {0.0});
  scene.surfaces.resize(2);
  scene.surfaces[1].exitance = {1.0};
  Solved solved(scene, Basis::linear, 10.0);
  const PatchForest& floor = solved.states[0].patches();
  ASSERT_EQ(floor.size(), 1u);
  double off = 0.0, light = 0.0;
  constexpr int side = 64;
  for (int i = 0; i < side * side; ++i) {
    const Vec3 x((i / side + 0.5) / side, (i % side + 0.5) / side, 0.0);
    std::vector<double> has(1);
    floor.evaluate(false, 0, x, has);
    const double truth = point_to_polygon(x, {0, 0, 1}, scene.surfaces[1].vertices);
    off += std::abs(truth - has[0]);
    light += truth;
  }
  const ErrorSampleSums sums = sampled(solved, 0, {.rays = 512, .per_area = 2000.0});
  EXPECT_NEAR(sums.light[0], light / (side * side), 0.02 * light / (side * side));
  EXPECT_NEAR(sums.off[0] / sums.light[0], off / light, 0.1 * off / light);
  EXPECT_LT(sums.noise[0], 0.2 * sums.off[0]);
  // The patch has the mean of the floor: what points at random differ by is all there is.
  EXPECT_GT(sums.surplus_variance[0], 0.0);
  EXPECT_LT(sums.surplus[0] * sums.surplus[0], 16.0 * sums.surplus_variance[0]);
}

/// All over 5% too bright, in a room where rays alone bring the light: the sign is found, and noise
/// does not hide it.
TEST(ErrorSamples, FindAnErrorOfAllLight) {
  Scene scene = testing::box_room({0, 0, 0}, {4, 5, 3}, {0.5}, {0.5});
  testing::add_block(scene, {1, 1, 0.3}, {2, 2.5, 1.2}, {0.5}, {0.5});
  Solved solved(scene, Basis::linear, 1e-3);
  const ErrorSampleConfig config{.rays = 128, .per_area = 2.0, .mean_irradiance = 1.0};
  ErrorSampleSums right, wrong;
  for (std::size_t c = 0; c < solved.states.size(); ++c) add(right, sampled(solved, c, config));
  EXPECT_NEAR(right.off[0] / right.light[0], 0.0, 2e-3);
  for (std::size_t c = 0; c < solved.states.size(); ++c) {
    ClusterState bright = solved.states[c];
    bright.correct(std::vector<double>(bright.aggregates().size(), 0.05));
    WorkCount work;
    ErrorSamples samples(bright, solved.occluders, config, work);
    for (const ClusterState& state : solved.states) samples.add(state);
    add(wrong, samples.compare(bright));
  }
  EXPECT_NEAR(wrong.surplus[0] / wrong.light[0], -0.05, 5e-3);
  EXPECT_GT(wrong.surplus[0] * wrong.surplus[0], 16.0 * wrong.surplus_variance[0]);
}

/// A lamp behind more wires than are cut out of it gets rays of its own: what they find hidden is
/// hidden.
TEST(ErrorSamples, SeeALampThroughAGrille) {
  constexpr int wires = 60;
  Scene scene = testing::box_room({0, 0, 0}, {1, 1, 1}, {0.0}, {0.0});
  scene.surfaces.resize(1);
  const auto add = [&scene](Polygon corners, double exitance) {
    Surface surface;
    surface.vertices = std::move(corners);
    surface.reflectance = {0.0};
    surface.exitance = {exitance};
    scene.surfaces.push_back(surface);
  };
  add({{.4, .4, 1}, {.4, .6, 1}, {.6, .6, 1}, {.6, .4, 1}}, 1.0);
  const auto bars = [&](int i) {
    const double x = 0.4 + 0.2 * (i + 0.5) / wires, half = 0.04 / wires;  // hide 2 of 5
    return Polygon{
        {x - half, .3, .99}, {x + half, .3, .99}, {x + half, .7, .99}, {x - half, .7, .99}};
  };
  for (int i = 0; i < wires; ++i) add(bars(i), 0.0);
  Solved solved(scene, Basis::linear, 1e-2);
  double truth = 0.0;
  constexpr int side = 24;
  VisibleParts parts;
  for (int i = 0; i < side * side; ++i) {
    parts.begin({(i / side + 0.5) / side, (i % side + 0.5) / side, 0.0}, scene.surfaces[1].vertices,
                1e-9);
    for (int k = 0; k < wires; ++k) ASSERT_TRUE(parts.hide(bars(k), 100000));
    truth += parts.factor({0, 0, 1}) / (side * side);
  }
  const ErrorSampleSums sums =
      sampled(solved, 0, {.rays = 128, .per_area = 400.0, .mean_irradiance = 1e-3});
  EXPECT_NEAR(sums.light[0], truth, 0.03 * truth);
  EXPECT_GT(sums.noise[0], 0.0);
}

/// In a furnace every ray brings the same: how many meet what is not counted is no noise.
TEST(ErrorSamples, AreExactWhereLightIsEven) {
  Scene scene = testing::box_room({0, 0, 0}, {4, 5, 3}, {0.5}, {0.5});
  testing::add_block(scene, {1, 1, 0.3}, {2, 2.5, 1.2}, {0.5}, {0.5});
  Solved solved(scene, Basis::constant, 0.1);
  const ErrorSampleConfig config{.rays = 32, .per_area = 4.0, .mean_irradiance = 1.0};
  for (ClusterState& state : solved.states) {
    for (std::size_t i = 0; i < state.patches().size(); ++i) {
      state.patches().radiosity(i)[0] = state.patches().irradiance(i)[0] = 1.0;
    }
  }
  for (std::size_t c = 0; c < solved.states.size(); ++c) {
    const ErrorSampleSums sums = sampled(solved, c, config);
    EXPECT_LT(sums.off[0], 1e-3 * sums.light[0]) << c;
    EXPECT_LT(sums.noise[0], 1e-3 * sums.light[0]) << c;
  }
}

TEST(ErrorSamples, NoPointsNoRays) {
  Solved solved(testing::box_room({0, 0, 0}, {1, 1, 1}, {0.5}, {0.5}), Basis::linear, 1e-2);
  WorkCount work;
  ErrorSamples none(solved.states[0], solved.occluders, {}, work);
  none.add(solved.states[1]);
  EXPECT_EQ(work.rays, 0u);
  EXPECT_EQ(none.compare(solved.states[0]).light[0], 0.0);
}

}  // namespace
}  // namespace enfilade
