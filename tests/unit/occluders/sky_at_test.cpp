// What a sky brings to points, against closed forms and sums over directions.
#include "occluders/sky_at.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "unit/gather/box_room.hpp"

namespace enfilade {
namespace {

using std::numbers::pi;

/// A square of 2 x 2 m on the ground under a sky.
struct Outside {
  Scene scene;
  std::vector<Cluster> clusters;
  Occluders occluders;

  explicit Outside(const Sky& sky, std::vector<Surface> more = {})
      : scene(made(sky, std::move(more))), clusters(made_clusters(scene)), occluders(clusters) {}
  static Scene made(const Sky& sky, std::vector<Surface> more) {
    Scene scene;
    Surface ground;
    ground.vertices = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    ground.reflectance = ground.exitance = {0.0};
    scene.surfaces = {ground};
    for (Surface& surface : more) scene.surfaces.push_back(std::move(surface));
    scene.sky = sky;
    make_sky_lights(scene);
    return scene;
  }
  static std::vector<Cluster> made_clusters(const Scene& scene) {
    std::vector<Cluster> clusters = testing::clusters_of(scene);
    set_panes(clusters, scene);
    return clusters;
  }
  double light(const Vec3& x, const Vec3& n) const {
    double sum = 0.0;
    for (const LightSource& light : scene.lights)
      sum += light.intensity[0] * light_at(light, {x, n}, occluders).irradiance;
    return sum;
  }
};

Sky sky_of(const SkyShape& shape, double elevation = 50.0) {
  Sky sky;
  sky.shape = shape;
  const double h = elevation * pi / 180.0;
  sky.sun = {std::cos(h) * 0.6, std::cos(h) * 0.8, std::sin(h)};
  sky.zenith_luminance = {1000.0};
  return sky;
}

/// By steps of solid angle over the whole sphere.
double summed(const Sky& sky, const Vec3& n) {
  constexpr int steps = 240;
  double sum = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double z = (i + 0.5) / steps, r = std::sqrt(1.0 - z * z);
    for (int k = 0; k < 2 * steps; ++k) {
      const double turn = pi * (k + 0.5) / steps;
      const Vec3 w(r * std::cos(turn), r * std::sin(turn), z);
      sum += std::max(0.0, glm::dot(w, n)) * sky.relative(w);
    }
  }
  return 1000.0 * sum * 2.0 * pi / (2.0 * steps * steps);
}

TEST(SkyAt, IsTheClosedFormOfUniformAndOvercastSkies) {
  SkyShape overcast;
  overcast.overcast = true;
  const Vec3 x(0.3, 0.2, 0.01), up(0, 0, 1), aside(1, 0, 0);
  const Outside even(sky_of(SkyShape::of_type(5))), grey(sky_of(overcast));
  EXPECT_NEAR(even.light(x, up), 1000.0 * pi, 0.1);
  EXPECT_NEAR(grey.light(x, up), 1000.0 * 7.0 * pi / 9.0, 0.1);
  // A vertical plane has half of the uniform sky, and (pi/6 + 4/9) Lz of the overcast one.
  EXPECT_NEAR(even.light(x, aside), 1000.0 * pi / 2.0, 0.1);
  EXPECT_NEAR(grey.light(x, aside), 1000.0 * (pi / 6.0 + 4.0 / 9.0), 0.1);
  EXPECT_NEAR(even.scene.sky->horizontal(true)[0], 1000.0 * pi, 1e-3);
  EXPECT_NEAR(grey.scene.sky->horizontal(true)[0], 1000.0 * 7.0 * pi / 9.0, 0.05);
}

TEST(SkyAt, IsTheSumOverDirectionsOfAllStandardSkies) {
  for (int type = 1; type <= 15; ++type) {
    const Sky sky = sky_of(SkyShape::of_type(type));
    const Outside outside(sky);
    for (const Vec3& n : {Vec3(0, 0, 1), Vec3(1, 0, 0), glm::normalize(Vec3(-0.4, 0.3, 0.5))}) {
      const double expected = summed(sky, n);
      EXPECT_NEAR(outside.light({0, 0, 0.01}, n), expected, 1e-3 * expected) << type << " " << n.x;
    }
    const double level = summed(sky, {0, 0, 1});
    EXPECT_NEAR(sky.horizontal(false)[0], level, 1e-3 * level) << type;
  }
}

TEST(SkyAt, SunAndGroundAreThatOfTheirOwn) {
  Sky sky = sky_of(SkyShape::of_type(5), 30.0);
  sky.sun_illuminance = {80000.0};
  sky.ground_reflectance = {0.25};
  const Outside outside(sky);
  const double level = 1000.0 * pi + 80000.0 * 0.5;
  EXPECT_NEAR(outside.light({0, 0, 0.01}, {0, 0, 1}), level, 1e-3 * level);
  EXPECT_NEAR(sky.horizontal(true)[0], level, 1e-3 * level);
  // Away from the sun, high above the square, which hides ground: half of the sky, half of the
  // ground.
  const double aside = 0.5 * 1000.0 * pi + 0.5 * 0.25 * level;
  EXPECT_NEAR(outside.light({0, 0, 60.0}, {-0.6, -0.8, 0}), aside, 1e-3 * aside);
}

TEST(SkyAt, IsHiddenByWallsAndDimmedByPanes) {
  // A tall wall at x = 1 hides half of what a plane sees that faces it, and a pane dims the rest.
  Surface wall, pane;
  wall.vertices = {{1, -500, -1}, {1, 500, -1}, {1, 500, 500}, {1, -500, 500}};
  wall.reflectance = wall.exitance = {0.0};
  pane.vertices = {{-0.5, -0.5, 0.4}, {0.5, -0.5, 0.4}, {0.5, 0.5, 0.4}, {-0.5, 0.5, 0.4}};
  pane.reflectance = pane.exitance = {0.0};
  pane.transmittance = {0.5};
  const Sky sky = sky_of(SkyShape::of_type(5));
  const Outside walled(sky, {wall});
  EXPECT_NEAR(walled.light({0.99, 0, 0.01}, {0, 0, 1}), 0.5 * 1000.0 * pi, 6.0);
  // Straight below a pane that nearly fills the view.
  const Outside glazed(sky, {pane});
  const double plain = 1000.0 * pi, dimmed = glazed.light({0, 0, 0.3999}, {0, 0, 1});
  EXPECT_GT(dimmed, 0.42 * plain);
  EXPECT_LT(dimmed, 0.5 * plain);
}

}  // namespace
}  // namespace enfilade
