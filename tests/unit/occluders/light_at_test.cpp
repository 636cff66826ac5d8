// What lights bring to points, against closed forms and brute force.
#include "occluders/light_at.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <tuple>

#include "geometry/form_factor.hpp"
#include "scene/scene.hpp"

namespace enfilade {
namespace {

using std::numbers::pi;

/// I0 cos^n of the angle from the aim, by a table.
std::shared_ptr<const IntensityDistribution> cosine_power(double n, double step = 1.0) {
  IntensityTable table;
  table.planes = {0.0};
  for (double angle = 0.0; angle <= 90.0; angle += step) {
    table.angles.push_back(angle);
    table.candela.push_back(angle < 90.0 ? std::pow(std::cos(angle * pi / 180.0), n) : 0.0);
  }
  return std::make_shared<const IntensityDistribution>(std::move(table));
}

/// A luminaire of the flux 4 pi, so that its mean intensity is 1.
LightSource luminaire(const Vec3& p, std::shared_ptr<const IntensityDistribution> distribution,
                      const LuminousOpening& opening = {}) {
  LightSource light{p, {1.0}};
  light.distribution = std::move(distribution);
  light.shape = opening;
  make_opening(light);
  return light;
}

/// Nothing but a wall far away.
struct Space {
  std::vector<Cluster> clusters;
  Occluders occluders;
  explicit Space(
      const std::vector<Polygon>& walls = {{{-99, 0, -50}, {-99, 1, -50}, {-98, 0, -50}}})
      : clusters(made(walls)), occluders(clusters) {}
  static std::vector<Cluster> made(const std::vector<Polygon>& walls) {
    Cluster cluster;
    cluster.id = ClusterId(0u);
    cluster.cell = CellId(0u);
    for (const Polygon& wall : walls) {
      cluster.polygons.push_back({SurfaceId(0u), wall});
      for (const Vec3& v : wall) cluster.bounds.add(v);
    }
    return {cluster};
  }
};

TEST(LightAt, IsTheClosedFormOfAPointOverAFloor) {
  // E = I(theta) cos^3(theta) / h^2, with I = I0 cos^n and I0 = (n + 1) flux / (2 pi).
  const Space space;
  constexpr double h = 2.5;
  for (const double n : {1.0, 3.0, 40.0}) {
    const LightSource light = luminaire({0.0, 0.0, h}, cosine_power(n, n > 10.0 ? 0.25 : 1.0));
    for (const double x : {0.0, 0.4, 1.1, 3.0}) {
      const double cosine = h / std::hypot(h, x);
      const double expected = 2.0 * (n + 1.0) * std::pow(cosine, n + 3.0) / (h * h);
      const LightAtPoint found = light_at(light, {{x, 0.0, 0.0}, {0, 0, 1}}, space.occluders);
      if (expected < 1e-4) continue;
      EXPECT_NEAR(found.irradiance, expected, 1e-3 * expected) << n << " at " << x;
      EXPECT_EQ(found.error, 0.0);
    }
  }
}

/// By a midpoint rule of n x n points over a rectangle of 1.2 x 0.6 m about p.
double brute_force(const LightSource& light, const Vec3& x, const Vec3& n, int steps) {
  double sum = 0.0;
  for (int i = 0; i < steps; ++i) {
    for (int j = 0; j < steps; ++j) {
      const Vec3 y = light.p + 1.2 * ((i + 0.5) / steps - 0.5) * light.frame.right +
                     0.6 * ((j + 0.5) / steps - 0.5) * light.frame.up;
      const Vec3 d = y - x;
      const double r = glm::length(d);
      sum += std::max(0.0, glm::dot(d, n)) / (r * r * r) * relative_intensity(light, -d);
    }
  }
  return sum / (steps * steps);
}

TEST(LightAt, OfAnOpeningAgreesWithQuadratureFromItsSizeOn) {
  const Space space;
  for (const double n : {1.0, 6.0}) {
    const LightSource light = luminaire({0.3, -0.2, 3.0}, cosine_power(n, 0.5),
                                        {OpeningShape::rectangle, {1.2, 0.6, 0.0}});
    for (const double distance : {0.3, 1.2, 12.0}) {
      for (const Vec3& offset : {Vec3(0.0), Vec3(0.4, 0.3, 0.0), Vec3(-1.0, 0.5, 0.0)}) {
        const Vec3 x = light.p - Vec3(0, 0, distance) + offset * std::min(distance, 1.0);
        const Vec3 normal = glm::normalize(Vec3(0.2, -0.1, 1.0));
        const LightAtPoint found = light_at(light, {x, normal}, space.occluders);
        const double expected = brute_force(light, x, normal, 400);
        EXPECT_NEAR(found.irradiance, expected, 1e-3 * expected) << n << ' ' << distance;
        EXPECT_LT(found.error, 2e-3 * expected);
      }
    }
  }
}

TEST(LightAt, FindsANarrowBeamBetweenThePointsOfALargeOpening) {
  // Each point of the opening sends a beam of 2 degrees down: the floor below has the opening's
  // flux per area, and beside it there is nothing.
  const Space space;
  const double outer = 1.0 * pi / 180.0;
  LightSource light = spot_light({0, 0, 2.5}, {0, 0, -1}, {1.0}, {0.5 * outer, outer});
  light.intensity = {1.0};
  light.shape = {OpeningShape::rectangle, {1.2, 0.6, 0.0}};
  make_opening(light);
  for (const double x : {0.0, 0.13, 0.4}) {
    const LightAtPoint found = light_at(light, {{x, 0.04, 0}, {0, 0, 1}}, space.occluders);
    const double expected = 4.0 * pi / (1.2 * 0.6);
    EXPECT_NEAR(found.irradiance, expected, 0.05 * expected) << x;
  }
  EXPECT_EQ(light_at(light, {{0.9, 0, 0}, {0, 0, 1}}, space.occluders).irradiance, 0.0);
}

TEST(LightAt, LambertianOpeningPolygonAndPointAgree) {
  // A dull polygon of exitance M gives M F; as a luminaire of the same flux the same at any
  // distance. Ten sizes away a point differs by the opening's second moments alone: on the axis by
  // 2 (a^2 + b^2) / (12 d^2) = 0.2 %.
  const Space space;
  const LightSource opening =
      luminaire({0, 0, 0}, cosine_power(1.0, 0.5), {OpeningShape::rectangle, {1.2, 0.6, 0.0}});
  const LightSource point = luminaire({0, 0, 0}, cosine_power(1.0, 0.5));
  const double exitance = 4.0 * pi / (1.2 * 0.6);
  for (const double distance : {1.2, 12.0}) {
    for (const double aside : {0.0, 0.5}) {
      const Vec3 x(aside * distance, 0.3 * aside * distance, -distance);
      const Vec3 n = glm::normalize(Vec3(0.1, 0.0, 1.0));
      Polygon polygon = opening.opening[0];
      if (normal(polygon).z > 0.0) std::reverse(polygon.begin(), polygon.end());
      const double expected = exitance * point_to_polygon(x, n, polygon);
      const double found = light_at(opening, {x, n}, space.occluders).irradiance;
      EXPECT_NEAR(found, expected, 1e-3 * expected) << distance;
      if (distance > 10.0) {
        EXPECT_NEAR(light_at(point, {x, n}, space.occluders).irradiance, expected,
                    2.5e-3 * expected);
      }
    }
  }
}

TEST(LightAt, FollowsAimAndUp) {
  // The same scene turned as a whole has the same light.
  const Space space;
  IntensityTable table;
  for (int c = 0; c <= 360; c += 10) table.planes.push_back(c);
  for (int g = 0; g <= 180; g += 5) table.angles.push_back(g);
  for (const double c : table.planes)
    for (const double g : table.angles)
      table.candela.push_back(1.2 + std::cos(g * pi / 180) +
                              0.5 * std::sin(g * pi / 180) * std::cos((c - 70) * pi / 180));
  const auto distribution = std::make_shared<const IntensityDistribution>(table);
  LightSource light{{1, 2, 3}, {1.0}};
  light.distribution = distribution;
  light.shape = {OpeningShape::rectangle, {0.4, 0.2, 0.0}};
  make_opening(light);
  const Vec3 x(0.4, 1.1, 1.2), n = glm::normalize(Vec3(0.3, 0.4, 0.8));
  const double expected = light_at(light, {x, n}, space.occluders).irradiance;
  // A turn about the axis (1, 2, 2) / 3 by 100 degrees (Rodrigues).
  const auto turned = [](const Vec3& v) {
    const Vec3 k(1.0 / 3, 2.0 / 3, 2.0 / 3);
    const double c = std::cos(100 * pi / 180), s = std::sin(100 * pi / 180);
    return c * v + s * glm::cross(k, v) + (1 - c) * glm::dot(k, v) * k;
  };
  LightSource other = light;
  other.p = turned(light.p);
  other.frame = LightFrame::of(turned(light.frame.aim), turned(light.frame.up)).value();
  make_opening(other);
  EXPECT_NEAR(light_at(other, {turned(x), turned(n)}, space.occluders).irradiance, expected,
              1e-9 * expected);
  // Another up is another light; the half-plane C = 90 is up.
  EXPECT_EQ(LightFrame::of({0, 0, -1}, {0, 1, 0})->right, Vec3(1, 0, 0));
  other.frame = LightFrame::of(turned(light.frame.aim), turned({1, 0, 0})).value();
  EXPECT_GT(
      std::abs(light_at(other, {turned(x), turned(n)}, space.occluders).irradiance - expected),
      0.02 * expected);
  EXPECT_FALSE(LightFrame::of({0, 0, -1}, {0, 0, 2}).has_value());
}

TEST(LightAt, KnowsThePenumbraOfAnOpening) {
  // A half-plane at half the height hides x > 0; straight below, half of the opening is seen.
  const Space space({{{0.0, -9, 1.0}, {0.0, 9, 1.0}, {9, 9, 1.0}, {9, -9, 1.0}}});
  const LightSource light =
      luminaire({0, 0, 2.0}, cosine_power(1.0, 0.5), {OpeningShape::rectangle, {1.0, 1.0, 0.0}});
  for (const double x : {0.0, 0.21, -0.33}) {
    // From x, the edge at (0, 1) hides the part of the opening with y.x > -x.
    double expected = 0.0;
    constexpr int steps = 600;
    for (int i = 0; i < steps; ++i) {
      for (int j = 0; j < steps; ++j) {
        const Vec3 y((i + 0.5) / steps - 0.5, (j + 0.5) / steps - 0.5, 2.0);
        if (y.x > -x) continue;
        const Vec3 d = y - Vec3(x, 0, 0);
        const double r = glm::length(d);
        expected += d.z / (r * r * r) * relative_intensity(light, -d) / (steps * steps);
      }
    }
    const LightAtPoint found = light_at(light, {{x, 0, 0}, {0, 0, 1}}, space.occluders);
    EXPECT_NEAR(found.irradiance, expected, std::max(found.error, 2e-3 * expected)) << x;
    EXPECT_LT(found.error, 0.06 * expected);
  }
}

/// Strips across the x axis at the height z, side by side from x = -1 on.
std::vector<Polygon> strips(int count, double spacing, double width, double z) {
  std::vector<Polygon> list;
  for (int i = 0; i < count; ++i) {
    const double x = -1.0 + spacing * i;
    list.push_back({{x, -3, z}, {x + width, -3, z}, {x + width, 3, z}, {x, 3, z}});
  }
  return list;
}

TEST(LightAt, FindsStripsThatNoPointOfTheOpeningMeets) {
  // A flat opening of one distribution, of which the strips hide slices along y.
  const LightSource light =
      luminaire({0, 0, 2.0}, cosine_power(1.0, 0.5), {OpeningShape::rectangle, {1.0, 1.0, 0.0}});
  for (const auto& [count, spacing, width, z] :
       {std::tuple{30, 0.08, 0.01, 1.6}, {4, 0.5, 0.004, 1.9}, {200, 0.01, 0.003, 1.0}}) {
    const Space space(strips(count, spacing, width, z));
    const auto hidden = [&](double x) {
      for (int i = 0; i < count; ++i)
        if (x > -1.0 + spacing * i && x < -1.0 + spacing * i + width) return true;
      return false;
    };
    for (const Vec3& x : {Vec3(0.0), Vec3(0.21, 0.3, 0.4), Vec3(1.5, 0.0, 0.3)}) {
      double expected = 0.0;
      constexpr int steps = 8000, rows = 40;
      for (int i = 0; i < steps; ++i) {
        for (int j = 0; j < rows; ++j) {
          const Vec3 y((i + 0.5) / steps - 0.5, (j + 0.5) / rows - 0.5, 2.0);
          const Vec3 d = y - x;
          if (hidden(x.x + (z - x.z) / d.z * d.x)) continue;
          const double r = glm::length(d);
          expected += d.z / (r * r * r) * relative_intensity(light, -d) / (steps * rows);
        }
      }
      const LightAtPoint found = light_at(light, {x, {0, 0, 1}}, space.occluders);
      EXPECT_NEAR(found.irradiance, expected, std::max(2.0 * found.error, 2e-3 * expected))
          << count << " strips at " << x.x;
      EXPECT_LT(found.error, 0.02 * expected);
    }
  }
}

TEST(LightAt, KnowsItsErrorBehindAFineMesh) {
  // Wires of 0.3 mm every 1.2 mm both ways: more before each part of the opening than are cut out.
  std::vector<Polygon> wires = strips(1600, 0.0012, 0.0003, 1.0);
  for (Polygon wire : strips(1600, 0.0012, 0.0003, 1.0)) {
    for (Vec3& v : wire) std::swap(v.x, v.y);
    wires.push_back(wire);
  }
  const Space open, space(wires);
  const LightSource light =
      luminaire({0, 0, 2.0}, cosine_power(1.0, 0.5), {OpeningShape::rectangle, {1.0, 1.0, 0.0}});
  const Vec3 x(0.1, 0.03, 0.0), n(0, 0, 1);
  const double expected = 0.75 * 0.75 * light_at(light, {x, n}, open.occluders).irradiance;
  const LightAtPoint found = light_at(light, {x, n}, space.occluders);
  EXPECT_GT(found.error, 0.005 * expected);
  EXPECT_NEAR(found.irradiance, expected, 3.0 * found.error);
}

}  // namespace
}  // namespace enfilade
