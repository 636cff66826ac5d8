#include "solver/sequential_solver.hpp"

#include <gtest/gtest.h>

#include "final_gather/point_gather.hpp"

namespace enfilade {
namespace {

Surface wall(const char* name, double reflectance, double exitance, std::vector<Vec3> vertices) {
  Surface s;
  s.name = name;
  s.vertices = std::move(vertices);
  s.reflectance = {reflectance};
  s.exitance = {exitance};
  return s;
}

/// A cube of 1 m whose ceiling alone emits, 100 W/m2. Black but for the ceiling, so that the light
/// on the floor is that of the ceiling by closed form.
Scene cube(double reflectance) {
  Scene scene;
  scene.surfaces = {wall("floor", reflectance, 0, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}),
                    wall("ceiling", reflectance, 100, {{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}}),
                    wall("south", reflectance, 0, {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}}),
                    wall("north", reflectance, 0, {{0, 1, 0}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1}}),
                    wall("west", reflectance, 0, {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}}),
                    wall("east", reflectance, 0, {{1, 0, 0}, {1, 0, 1}, {1, 1, 1}, {1, 1, 0}})};
  return scene;
}

struct Solved {
  Prepared prepared;
  Occluders occluders;
  Solution solution;
};
Solved solve(const Scene& scene, const SolverConfig& config) {
  Warnings warnings;
  std::vector<Leak> leaks;
  Prepared prepared = prepare_scene(scene, {}, warnings, leaks);
  Occluders occluders(prepared.clusters);
  Solution solution = solve_sequentially(prepared, occluders, config);
  return {std::move(prepared), std::move(occluders), std::move(solution)};
}

/// Mean irradiance of a surface.
double mean_irradiance(const Solution& solution, std::uint32_t surface) {
  double power = 0.0, area = 0.0;
  for (const ClusterState& state : solution.clusters) {
    const PatchForest& patches = state.patches();
    for (std::size_t k = 0; k < patches.polygons(); ++k) {
      if (patches.frames()[k].surface.value != surface) continue;
      power += patches.node(k).shape.area_m2 * patches.irradiance(k)[0];
      area += patches.node(k).shape.area_m2;
    }
  }
  return power / area;
}

TEST(SequentialSolver, GivesABlackCubeTheClosedFormFactors) {
  const Solved s = solve(cube(0.0), {});
  EXPECT_TRUE(s.solution.converged);
  // Opposite and adjoining sides of a cube: 0.199825 and 0.200044.
  EXPECT_NEAR(mean_irradiance(s.solution, 0), 19.9825, 0.02 * 20);
  EXPECT_NEAR(mean_irradiance(s.solution, 2), 20.0044, 0.02 * 20);
  EXPECT_NEAR(mean_irradiance(s.solution, 1), 0.0, 1e-9);
  // The centre of the floor, a parallel unit square at distance 1: 4 F of a quarter = 0.2394.
  const PointGather gather(s.solution.clusters, s.prepared.scene.lights, s.occluders, {});
  EXPECT_NEAR(gather.irradiance({0.5, 0.5, 1e-6}, {0, 0, 1})[0], 23.944, 0.02);
}

TEST(SequentialSolver, ReflectedLightIsAbsorbedInTheEnd) {
  const double reflectance = 0.6;
  const Solved s = solve(cube(reflectance), {});
  EXPECT_TRUE(s.solution.converged);
  EXPECT_LT(s.solution.error.total(), 0.02);
  double absorbed = 0.0;
  for (std::uint32_t side = 0; side < 6; ++side)
    absorbed += (1.0 - reflectance) * mean_irradiance(s.solution, side);
  EXPECT_NEAR(absorbed, 100.0, 0.5);
  // All of it was reflected from somewhere but what came straight from the ceiling.
  EXPECT_GT(mean_irradiance(s.solution, 1), 20.0);
  EXPECT_GT(mean_irradiance(s.solution, 0), mean_irradiance(s.solution, 1));
}

TEST(SequentialSolver, TargetPointsLeaveOtherRoomsRough) {
  Scene scene = cube(0.5);
  const std::size_t walls = scene.surfaces.size();
  for (const double x : {2.0, 4.0, 6.0}) {
    for (std::size_t i = 0; i < walls; ++i) {
      scene.surfaces.push_back(scene.surfaces[i]);
      for (Vec3& v : scene.surfaces.back().vertices) v.x += x;
    }
  }
  SolverConfig config;
  config.target_error = 0.002;
  const Solved everywhere = solve(scene, config);
  config.gather.target_points = {{{0.5, 0.5, 0.2}, {0, 0, 1}}, {{0.2, 0.7, 0.2}, {0, 0, 1}}};
  const Solved there = solve(scene, config);
  EXPECT_TRUE(there.solution.converged);
  const auto links = [](const Solved& s) { return s.solution.history.back().figures.links; };
  EXPECT_LT(static_cast<double>(links(there)), 0.5 * static_cast<double>(links(everywhere)));
  const auto at_points = [&](const Solved& s) {
    const PointGather gather(s.solution.clusters, {}, s.occluders, {});
    double sum = 0.0;
    for (const Probe& p : config.gather.target_points) sum += gather.irradiance(p.p, p.n)[0];
    return sum;
  };
  EXPECT_NEAR(at_points(there) / at_points(everywhere), 1.0, 0.004);
}

TEST(SequentialSolver, EndsAtTheLimitOfIterationsAndSaysSo) {
  SolverConfig config;
  config.max_iterations = 2;
  const Solved s = solve(cube(0.9), config);
  EXPECT_FALSE(s.solution.converged);
  EXPECT_EQ(s.solution.history.size(), 2u);
}

TEST(SequentialSolver, MethodsOfIterationAgree) {
  SolverConfig config;
  const double hybrid = mean_irradiance(solve(cube(0.6), config).solution, 0);
  config.method.jacobi = true;
  EXPECT_NEAR(mean_irradiance(solve(cube(0.6), config).solution, 0), hybrid, 0.01 * hybrid);
  config.method.coarse_correction = false;
  EXPECT_NEAR(mean_irradiance(solve(cube(0.6), config).solution, 0), hybrid, 0.01 * hybrid);
}

/// All that is emitted is absorbed, a hundredth at each reflection.
TEST(SequentialSolver, ComesToRestInFewIterationsHoweverMuchIsReflected) {
  SolverConfig config;
  config.tolerance = 1e-5;
  const Solved s = solve(cube(0.99), config);
  EXPECT_TRUE(s.solution.converged);
  EXPECT_LE(s.solution.history.size(), 25u);
  double absorbed = 0.0;
  for (std::uint32_t side = 0; side < 6; ++side)
    absorbed += 0.01 * mean_irradiance(s.solution, side);
  EXPECT_NEAR(absorbed, 100.0, 0.2);
}

}  // namespace
}  // namespace enfilade
