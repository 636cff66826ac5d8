// Luminaires in closed rooms: power is conserved, beams are found, and the light is that of closed
// forms.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "final_gather/point_gather.hpp"
#include "scene/make_lights.hpp"
#include "solver/sequential_solver.hpp"
#include "unit/gather/box_room.hpp"

namespace enfilade {
namespace {

using std::numbers::pi;

/// A beam of about 5 degrees, 20 degrees off the aim towards C = 40, over a weak even light.
std::shared_ptr<const IntensityDistribution> leaning_beam() {
  IntensityTable table;
  for (int c = 0; c <= 360; c += 5) table.planes.push_back(c);
  for (double g = 0; g <= 180; g += 1.0) table.angles.push_back(g);
  const auto direction = [](double c, double g) {
    c *= pi / 180;
    g *= pi / 180;
    return Vec3(std::sin(g) * std::cos(c), std::sin(g) * std::sin(c), std::cos(g));
  };
  const Vec3 axis = direction(40, 20);
  for (const double c : table.planes) {
    for (const double g : table.angles) {
      const double off = std::acos(std::clamp(glm::dot(axis, direction(c, g)), -1.0, 1.0));
      table.candela.push_back(5000.0 * std::exp(-std::pow(off * 180 / pi / 5.0, 2)) + 5.0);
    }
  }
  return std::make_shared<const IntensityDistribution>(std::move(table));
}

LightSource with(const Vec3& p, std::shared_ptr<const IntensityDistribution> distribution,
                 const LuminousOpening& opening) {
  LightSource light{p, {100.0}};
  light.distribution = std::move(distribution);
  light.shape = opening;
  return light;
}

SolverConfig config_of(double target_error) {
  SolverConfig config;
  config.target_error = target_error;
  return config;
}

/// Of the power that lights send, the share that a closed room of this reflectance absorbs.
double absorbed(const LightSource& light, double reflectance, double target,
                double* estimate = nullptr) {
  Scene scene = testing::box_room({0, 0, 0}, {5, 4, 3}, {reflectance}, {0.0});
  scene.lights = {light};
  Warnings warnings;
  std::vector<Leak> leaks;
  const Prepared prepared = prepare_scene(scene, {}, warnings, leaks);
  const Occluders occluders(prepared.clusters);
  const Solution solution = solve_sequentially(prepared, occluders, config_of(target));
  EXPECT_TRUE(solution.converged);
  if (estimate != nullptr) *estimate = solution.error.total();
  return solution.history.back().figures.absorbed_power[0] / (4.0 * pi * 100.0);
}

TEST(Luminaires, GiveAllTheirPowerToAClosedRoom) {
  const auto beam = leaning_beam();
  const Vec3 p(2.2, 1.7, 2.6);
  const double spot_angle = 1.5 * pi / 180.0;
  LightSource spot = spot_light(p, {0.37, 0.21, -1.0}, {1.0}, {0.5 * spot_angle, spot_angle});
  spot.intensity = {100.0};
  for (const LightSource& light :
       {with(p, beam, {}), with(p, beam, {OpeningShape::rectangle, {1.2, 0.3, 0.0}}),
        with(p, beam, {OpeningShape::ellipsoid, {0.3, 0.3, 0.3}}), spot}) {
    for (const double reflectance : {0.0, 0.5}) {
      const double share = absorbed(light, reflectance, 0.02);
      EXPECT_NEAR(share, 1.0, 0.01) << reflectance;
    }
  }
}

struct Lit {
  Prepared prepared;
  Occluders occluders;
  Solution solution;

  Lit(const Scene& scene, double target)
      : prepared(made(scene)),
        occluders(prepared.clusters),
        solution(solve_sequentially(prepared, occluders, config_of(target))) {}
  static Prepared made(const Scene& scene) {
    Warnings warnings;
    std::vector<Leak> leaks;
    return prepare_scene(scene, {}, warnings, leaks);
  }
  PointGather gather() const {
    return PointGather(solution.clusters, prepared.scene.lights, occluders, {});
  }
};

TEST(Luminaires, LightABlackFloorAsTheClosedFormHasIt) {
  // E = I(theta) cos^3 / h^2 under a point of the distribution cos^4, by the patches and at points.
  Scene scene = testing::box_room({0, 0, 0}, {5, 4, 3}, {0.0}, {0.0});
  IntensityTable table;
  table.planes = {0.0};
  for (double g = 0; g <= 90; g += 1) {
    table.angles.push_back(g);
    table.candela.push_back(g < 90 ? std::pow(std::cos(g * pi / 180), 4) : 0.0);
  }
  scene.lights = {with({2.0, 1.5, 2.5}, std::make_shared<const IntensityDistribution>(table), {})};
  const Lit lit(scene, 0.01);
  const PointGather gather = lit.gather();
  double off = 0.0, sum = 0.0;
  for (double x = 0.2; x < 5.0; x += 0.4) {
    for (double y = 0.2; y < 4.0; y += 0.4) {
      const Vec3 at(x, y, 0.0);
      const double cosine = 2.5 / glm::length(at - Vec3(2.0, 1.5, 2.5));
      const double expected = 100.0 * 10.0 * std::pow(cosine, 7) / (2.5 * 2.5);
      EXPECT_NEAR(gather.irradiance(at, {0, 0, 1})[0], expected, 1e-3 * expected);
      off += std::abs(gather.from_patches(at, {0, 0, 1})[0] - expected);
      sum += expected;
    }
  }
  EXPECT_LT(off, 0.01 * sum);
}

TEST(Luminaires, NarrowSpotOnALargeFloorIsFound) {
  // The four points of the floor's first link, its centre and its corners all lie outside the beam.
  Scene scene = testing::box_room({0, 0, 0}, {20, 20, 6}, {0.3}, {0.0});
  const double outer = 2.0 * pi / 180.0;
  scene.lights = {spot_light({7.3, 11.9, 5.5}, {0.05, -0.03, -1.0}, {1000.0}, {outer / 2, outer})};
  const Lit lit(scene, 0.02);
  const PointGather gather = lit.gather();
  const Vec3 middle = Vec3(7.3, 11.9, 5.5) + 5.5 * Vec3(0.05, -0.03, -1.0);
  const double r = glm::length(middle - Vec3(7.3, 11.9, 5.5));
  const double expected = 1000.0 * 5.5 / (r * r * r);
  EXPECT_NEAR(gather.irradiance(middle, {0, 0, 1})[0], expected, 0.01 * expected);
  EXPECT_NEAR(gather.from_patches(middle, {0, 0, 1})[0], expected, 0.1 * expected);
  EXPECT_NEAR(gather.from_patches(middle + Vec3(1.0, 0, 0), {0, 0, 1})[0], 0.0, 0.01 * expected);
}

TEST(Luminaires, SurfaceWithALambertianDistributionIsAnEmittingSurface) {
  // The same lamp as a plain emitting polygon, and as one with a table of the cosine.
  const auto room = [](bool with_table) {
    Scene scene = testing::box_room({0, 0, 0}, {4, 3, 2.5}, {0.5}, {0.0});
    Surface lamp;
    lamp.vertices = {{1.5, 1, 2.4}, {1.5, 2, 2.4}, {2.1, 2, 2.4}, {2.1, 1, 2.4}};
    lamp.reflectance = {0.0};
    lamp.exitance = {500.0};
    if (with_table) {
      IntensityTable table;
      table.planes = {0.0};
      for (double g = 0; g <= 90; g += 1) {
        table.angles.push_back(g);
        table.candela.push_back(g < 90 ? std::cos(g * pi / 180) : 0.0);
      }
      lamp.distribution = std::make_shared<const IntensityDistribution>(table);
    }
    scene.surfaces.push_back(lamp);
    return scene;
  };
  const Lit plain(room(false), 0.01), table(room(true), 0.01);
  ASSERT_EQ(table.prepared.scene.lights.size(), 1u);
  EXPECT_NEAR(table.prepared.scene.lights[0].intensity[0] * 4.0 * pi, 300.0, 1e-6);
  const PointGather a = plain.gather(), b = table.gather();
  for (const Vec3& p : {Vec3(1.8, 1.5, 0.0), Vec3(0.5, 0.5, 0.0), Vec3(1.8, 1.5, 1.6)}) {
    const double expected = a.irradiance(p, {0, 0, 1})[0];
    EXPECT_NEAR(b.irradiance(p, {0, 0, 1})[0], expected, 0.01 * expected);
  }
}

}  // namespace
}  // namespace enfilade
