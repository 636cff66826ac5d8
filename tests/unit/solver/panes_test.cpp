// Light through panes, at points and on patches, against quadratures and path tracing made here.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/random.hpp"
#include "final_gather/point_gather.hpp"
#include "geometry/sampling.hpp"
#include "solver/sequential_solver.hpp"
#include "unit/gather/box_room.hpp"

namespace enfilade {
namespace {

using std::numbers::pi;

/// Of a slab of index 1.52, relative to normal incidence: by the angles on both sides and the sum
/// over all reflections within.
double clear_glass(double cosine) {
  const auto slab = [](double r) {
    double sum = 0.0, way = (1.0 - r) * (1.0 - r);
    for (int k = 0; k < 200; ++k, way *= r * r) sum += way;
    return sum;
  };
  const double i = std::acos(std::min(std::abs(cosine), 1.0 - 1e-9));
  const double t = std::asin(std::sin(i) / 1.52);
  const double s = std::pow(std::sin(i - t) / std::sin(i + t), 2);
  const double p = std::pow(std::tan(i - t) / std::tan(i + t), 2);
  const double head_on = std::pow(0.52 / 2.52, 2);
  return 0.5 * (slab(s) + slab(p)) / slab(head_on);
}

struct LitThroughPanes {
  Prepared prepared;
  Occluders occluders;
  Solution solution;

  explicit LitThroughPanes(const Scene& scene, double target = 0.01)
      : prepared(made(scene)),
        occluders(prepared.clusters),
        solution(solve_sequentially(prepared, occluders, panes_config(target))) {}
  static SolverConfig panes_config(double target) {
    SolverConfig config;
    config.target_error = target;
    return config;
  }
  static Prepared made(const Scene& scene) {
    Warnings warnings;
    std::vector<Leak> leaks;
    return prepare_scene(scene, {}, warnings, leaks);
  }
  PointGather gather() const {
    return PointGather(solution.clusters, prepared.scene.lights, occluders, {});
  }
};

Surface pane(Polygon vertices, Spectrum transmittance, Spectrum reflectance) {
  Surface surface;
  surface.vertices = std::move(vertices);
  surface.exitance.assign(transmittance.size(), 0.0);
  surface.transmittance = std::move(transmittance);
  surface.reflectance = std::move(reflectance);
  return surface;
}

/// A rectangle at height z that faces down, counter-clockwise seen from below.
Polygon facing_down(double x0, double x1, double y0, double y1, double z) {
  return {{x0, y0, z}, {x0, y1, z}, {x1, y1, z}, {x1, y0, z}};
}

/// A black box 4 x 4 x 3 m with a lamp of 1 x 1.5 m just below the ceiling.
Scene black_room(int bands) {
  const Spectrum zero(static_cast<std::size_t>(bands), 0.0);
  Scene scene = testing::box_room({0, 0, 0}, {4, 4, 3}, zero, zero);
  Surface lamp;
  lamp.vertices = facing_down(0.5, 1.5, 1.0, 2.5, 2.9);
  lamp.reflectance = zero;
  lamp.exitance.assign(static_cast<std::size_t>(bands), 1000.0);
  scene.surfaces.push_back(lamp);
  return scene;
}

/// Irradiance from that lamp at x on a plane that faces up, through what `passes` lets through of
/// the way from x to a point of the lamp.
template <class Passes>
double from_lamp(const Vec3& x, const Passes& passes, int steps = 400) {
  double sum = 0.0;
  for (int i = 0; i < steps; ++i) {
    for (int j = 0; j < steps; ++j) {
      const Vec3 y(0.5 + (i + 0.5) / steps, 1.0 + 1.5 * (j + 0.5) / steps, 2.9);
      const Vec3 d = y - x;
      const double r2 = glm::dot(d, d);
      sum += d.z * d.z / (pi * r2 * r2) * passes(x, y);
    }
  }
  return 1000.0 * sum * 1.5 / (steps * steps);
}

/// Where the way from x to y passes height z.
Vec3 at_height(const Vec3& x, const Vec3& y, double z) {
  return x + (z - x.z) / (y.z - x.z) * (y - x);
}

const std::vector<Vec3> floor_points{{1, 1.7, 0}, {3.5, 0.5, 0}, {2.2, 3.6, 0}, {0.1, 0.1, 0}};

void expect_lamp_light(const Scene& scene, std::size_t band, const auto& passes) {
  const LitThroughPanes lit(scene);
  const PointGather gather = lit.gather();
  double off = 0.0, sum = 0.0;
  for (const Vec3& x : floor_points) {
    const double expected = from_lamp(x, passes);
    EXPECT_NEAR(gather.irradiance(x, {0, 0, 1})[band], expected, 1.5e-3 * expected) << x.x;
  }
  for (double x = 0.2; x < 4.0; x += 0.4) {
    for (double y = 0.2; y < 4.0; y += 0.4) {
      const double expected = from_lamp({x, y, 0}, passes, 40);
      off += std::abs(gather.from_patches({x, y, 0}, {0, 0, 1})[band] - expected);
      sum += expected;
    }
  }
  // A link has one tint for all of its receiver, which costs the bands that pass least some
  // accuracy.
  EXPECT_LT(off, (band == 0 ? 0.015 : 0.02) * sum);
}

TEST(Panes, DimByTheAngle) {
  Scene scene = black_room(1);
  scene.surfaces.push_back(pane(facing_down(0, 4, 0, 4, 1.3), {0.8}, {0.0}));
  expect_lamp_light(scene, 0, [](const Vec3& x, const Vec3& y) {
    return 0.8 * clear_glass(glm::normalize(y - x).z);
  });
}

TEST(Panes, CoverAPartOfTheView) {
  Scene scene = black_room(1);
  scene.surfaces.push_back(pane(facing_down(0, 1.2, 0, 4, 1.3), {0.5}, {0.0}));
  expect_lamp_light(scene, 0, [](const Vec3& x, const Vec3& y) {
    return at_height(x, y, 1.3).x < 1.2 ? 0.5 * clear_glass(glm::normalize(y - x).z) : 1.0;
  });
}

TEST(Panes, TwoInARowOfWhichOneIsTwoSidedAndTinted) {
  Scene scene = black_room(2);
  scene.surfaces.push_back(pane(facing_down(0, 4, 0, 4, 1.3), {0.8, 0.8}, {0.0, 0.0}));
  scene.surfaces.push_back(pane(facing_down(0, 4, 0, 2, 1.9), {0.9, 0.3}, {0.0, 0.0}));
  scene.surfaces.back().two_sided = true;
  for (const std::size_t band : {0u, 1u}) {
    expect_lamp_light(scene, band, [band](const Vec3& x, const Vec3& y) {
      const double share = clear_glass(glm::normalize(y - x).z);
      const double second = band == 0 ? 0.9 : 0.3;
      return 0.8 * share * (at_height(x, y, 1.9).y < 2.0 ? second * share : 1.0);
    });
  }
}

TEST(Panes, DimPointLights) {
  Scene scene = testing::box_room({0, 0, 0}, {4, 4, 3}, {0.0, 0.0}, {0.0, 0.0});
  scene.lights = {LightSource{{1.0, 1.5, 2.5}, {100.0, 100.0}}};
  scene.surfaces.push_back(pane(facing_down(0, 2.5, 0, 4, 1.3), {0.7, 0.2}, {0.0, 0.0}));
  const LitThroughPanes lit(scene);
  const PointGather gather = lit.gather();
  double off = 0.0, sum = 0.0;
  for (double x = 0.1; x < 4.0; x += 0.2) {
    for (double y = 0.1; y < 4.0; y += 0.2) {
      const Vec3 at(x, y, 0.0), d = Vec3(1.0, 1.5, 2.5) - at;
      const double r = glm::length(d), plain = 100.0 * d.z / (r * r * r);
      const bool through = at_height(at, {1.0, 1.5, 2.5}, 1.3).x < 2.5;
      const double share = through ? clear_glass(d.z / r) : 1.0;
      const Spectrum e = gather.irradiance(at, {0, 0, 1});
      EXPECT_NEAR(e[0], plain * share * (through ? 0.7 : 1.0), 1e-4 * plain);
      EXPECT_NEAR(e[1], plain * share * (through ? 0.2 : 1.0), 1e-4 * plain);
      off +=
          std::abs(gather.from_patches(at, {0, 0, 1})[1] - plain * share * (through ? 0.2 : 1.0));
      sum += plain;
    }
  }
  EXPECT_LT(off, 0.015 * sum);
}

/// A box 2 x 1 x 1 m with a pane at x = 1 that faces -x: light from the wall at x = 0, reflected by
/// walls and by the pane's front. Traced from `p` by chance alone.
struct BoxTracer {
  double rho = 0.5, pane_rho = 0.2, tau = 0.6;
  Random random{7};

  Vec3 diffuse(const Vec3& n) {
    const double r2 = random.uniform(), turn = random.uniform();
    return cosine_direction(n, r2, turn);
  }
  double one(Vec3 p, Vec3 n) {
    double light = 0.0, weight = 1.0;
    Vec3 d = diffuse(n);
    for (int step = 0; step < 400; ++step) {
      double t = 1e30;
      Vec3 met(0.0);
      const auto plane = [&](int axis, double at, const Vec3& facing) {
        const double s = (at - p[axis]) / d[axis];
        if (s > 1e-12 && s < t) {
          t = s;
          met = facing;
        }
      };
      for (int axis = 0; axis < 3; ++axis) {
        Vec3 up(0.0);
        up[axis] = 1.0;
        if (d[axis] < 0.0) plane(axis, 0.0, up);
        if (d[axis] > 0.0) plane(axis, axis == 0 ? 2.0 : 1.0, -up);
      }
      const double to_pane = (1.0 - p.x) / d.x;
      if (to_pane > 1e-12 && to_pane < t) {
        p += to_pane * d;
        p.x = 1.0;
        const double passes = tau * clear_glass(d.x);
        if (d.x > 0.0 && random.uniform() < 0.25) {  // its front reflects
          weight *= pane_rho / 0.25;
          d = diffuse({-1, 0, 0});
        } else {
          weight *= passes / (d.x > 0.0 ? 0.75 : 1.0);
        }
      } else {
        p += t * d;
        if (met.x > 0.5) light += weight;  // the wall at x = 0 emits 1
        if (random.uniform() >= rho) return light;
        d = diffuse(met);
      }
      if (weight < 0.02) {
        if (random.uniform() < 0.5) return light;
        weight *= 2.0;
      }
    }
    return light;
  }
};

TEST(Panes, ReflectAndPassAsPathTracingHasIt) {
  Scene scene = testing::box_room({0, 0, 0}, {2, 1, 1}, {0.5}, {0.0});
  scene.surfaces[2].exitance = {1.0};  // x = 0
  scene.surfaces.push_back(pane({{1, 0, 0}, {1, 0, 1}, {1, 1, 1}, {1, 1, 0}}, {0.6}, {0.2}));
  ASSERT_LT(normal(scene.surfaces.back().vertices).x, -0.9);
  const LitThroughPanes lit(scene, 0.005);
  EXPECT_TRUE(lit.solution.converged);
  const PointGather gather = lit.gather();
  struct Place {
    Vec3 p, n;
  };
  BoxTracer tracer;
  for (const Place& at : {Place{{1.999999, 0.5, 0.5}, {-1, 0, 0}}, Place{{1.5, 0.4, 0}, {0, 0, 1}},
                          Place{{0.5, 0.6, 0}, {0, 0, 1}}, Place{{0.000001, 0.5, 0.5}, {1, 0, 0}},
                          Place{{1.2, 0.5, 0.5}, {1, 0, 0}}}) {
    constexpr int paths = 1'000'000;
    double sum = 0.0, square = 0.0;
    for (int i = 0; i < paths; ++i) {
      const double light = tracer.one(at.p, at.n);
      sum += light;
      square += light * light;
    }
    const double mean = sum / paths, sigma = std::sqrt((square / paths - mean * mean) / paths);
    ASSERT_LT(sigma, 0.005 * mean);
    const PointIrradiance found = gather.at(at.p, at.n);
    EXPECT_NEAR(found.irradiance[0], mean, 4.0 * sigma + 0.006 * mean) << at.p.x << " " << at.n.x;
    // What it says of its own error holds it.
    EXPECT_LT(std::abs(found.irradiance[0] - mean), 4.0 * std::hypot(sigma, found.error[0]));
  }
}

TEST(Panes, AreNoWallsForCellsAndClusters) {
  // A room with a framed, glazed opening to another: light passes, and no floor is unreachable.
  Scene scene = testing::box_room({0, 0, 0}, {6, 3, 3}, {0.5}, {0.0});
  const auto wall = [&](double y0, double y1, double z0, double z1) {
    Surface s;
    s.vertices = {{3, y0, z0}, {3, y1, z0}, {3, y1, z1}, {3, y0, z1}};
    s.reflectance = {0.5};
    s.exitance = {0.0};
    s.two_sided = true;
    scene.surfaces.push_back(s);
  };
  wall(0, 1, 0, 3);
  wall(2, 3, 0, 3);
  wall(1, 2, 0, 0.8);
  wall(1, 2, 2, 3);
  scene.surfaces.push_back(pane({{3, 1, 0.8}, {3, 2, 0.8}, {3, 2, 2}, {3, 1, 2}}, {0.85}, {0.0}));
  scene.lights = {LightSource{{1.5, 1.5, 2.5}, {100.0}}};
  const LitThroughPanes lit(scene, 0.01);
  const PointGather gather = lit.gather();
  // Straight through the pane.
  const Vec3 at(4.6, 1.4, 0.0), d = Vec3(1.5, 1.5, 2.5) - at;
  const double r = glm::length(d), direct = 100.0 * d.z / (r * r * r);
  const double passed = 0.85 * clear_glass(d.x / r);
  EXPECT_NEAR(gather.at(at, {0, 0, 1}).direct[0], direct * passed, 1e-3 * direct);
  // Behind the wall only what the rooms reflect.
  EXPECT_GT(gather.irradiance({5.9, 0.1, 0.0}, {0, 0, 1})[0], 0.01 * direct);
  for (const ClusterState& cluster : lit.solution.clusters) {
    for (std::uint32_t k = 0; k < cluster.patches().polygons(); ++k)
      EXPECT_FALSE(cluster.patches().unreachable(k));
  }
}

}  // namespace
}  // namespace enfilade
