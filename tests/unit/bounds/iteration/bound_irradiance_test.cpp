// Intervals against answers that are known exactly, and against a path tracer of the test's own.
#include "bounds/iteration/bound_irradiance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/random.hpp"
#include "geometry/form_factor.hpp"
#include "geometry/sampling.hpp"
#include "scene/pane_law.hpp"
#include "unit/geometry/box_faces.hpp"

namespace enfilade {
namespace {

/// Adds the six sides of a box, their fronts inside, or outside where `solid`.
void add_box(BoundScene& scene, const Vec3& lo, const Vec3& hi, bool solid = false) {
  for (Polygon& side : test::box_faces(lo, hi, !solid))
    scene.polygons.push_back({std::move(side), {0.5}, {0.0}});
}

/// All polygons are one room.
void one_target(BoundScene& scene) {
  scene.targets.emplace_back();
  for (std::uint32_t k = 0; k < scene.polygons.size(); ++k) scene.targets[0].push_back(k);
}

BoundResult bound(const BoundScene& scene, std::size_t links, double width = 0.01) {
  return bound_irradiance(scene, {.relative_width = width, .most_links = links, .threads = 2});
}

void expect_holds(const Range& range, double truth, double off = 1e-9) {
  EXPECT_LE(range.lo, truth * (1.0 + 1e-9) + off);
  EXPECT_GE(range.hi, truth * (1.0 - 1e-9) - off);
}

TEST(BoundIrradiance, AFurnaceIsKnownExactly) {
  BoundScene scene;
  add_box(scene, Vec3(0), Vec3(4, 5, 3));
  add_box(scene, Vec3(1), Vec3(2), true);
  for (std::size_t k = 0; k < scene.polygons.size(); ++k) {
    const double rho = 0.05 * static_cast<double>(k + 1);
    scene.polygons[k].reflectance = {rho};
    scene.polygons[k].exitance = {100.0 * (1.0 - rho)};
  }
  one_target(scene);
  const BoundResult found = bound(scene, 3000);
  EXPECT_EQ(found.closed_polygons, 12u);
  for (const auto& ranges : found.polygons) {
    expect_holds(ranges[0], 100.0, 1e-6);
    EXPECT_LT(relative_width(ranges[0]), 0.02);
  }
}

TEST(BoundIrradiance, BlackPlatesHaveTheirFormFactor) {
  BoundScene scene;
  scene.polygons.push_back({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {0.0}, {50.0}});
  scene.polygons.push_back({{{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}}, {0.0}, {0.0}});
  const BoundResult found = bound(scene, 2000);
  expect_holds(found.polygons[1][0], 50.0 * 0.19982489569838746);
  EXPECT_LT(relative_width(found.polygons[1][0]), 0.01);
  EXPECT_LE(found.polygons[0][0].hi, 1e-9);
  EXPECT_EQ(found.stop, BoundStop::reached);
}

TEST(BoundIrradiance, BacksAreBlack) {
  BoundScene scene;
  scene.polygons.push_back({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {0.0}, {50.0}});
  scene.polygons.push_back({{{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}, {0.9}, {0.0}});
  const BoundResult found = bound(scene, 2000);
  EXPECT_LE(found.polygons[1][0].hi, 1e-9);
}

TEST(BoundIrradiance, EvenReflectanceGivesTheMeanByEnergy) {
  // What is emitted is absorbed: the mean irradiance of a closed room is M A_lamp / (A (1 - rho)).
  BoundScene scene;
  add_box(scene, Vec3(0), Vec3(2));
  scene.polygons[0].exitance = {30.0};
  one_target(scene);
  const BoundResult found = bound(scene, 500);
  expect_holds(found.targets[0][0], 30.0 * 4.0 / (24.0 * 0.5));
  EXPECT_LT(relative_width(found.targets[0][0]), 1e-6);
}

TEST(BoundIrradiance, APointLightInACubeGivesASixthToEachSide) {
  BoundScene scene;
  add_box(scene, Vec3(0), Vec3(4));
  for (BoundPolygon& p : scene.polygons) p.reflectance = {0.0};
  scene.lights.emplace_back();
  scene.lights.back().p = Vec3(2);
  scene.lights.back().intensity = {10.0};
  const BoundResult found = bound(scene, 500);
  for (const auto& ranges : found.polygons) {
    expect_holds(ranges[0], 10.0 * 4.0 * std::numbers::pi / (6.0 * 16.0));
    EXPECT_LT(relative_width(ranges[0]), 1e-3);
  }
}

TEST(BoundIrradiance, HoldsTheLightOfAnOpening) {
  BoundScene scene;
  add_box(scene, Vec3(0), Vec3(4));
  for (BoundPolygon& p : scene.polygons) p.reflectance = {0.0};
  LightSource& light = scene.lights.emplace_back();
  light.p = Vec3(2, 2, 3);
  light.intensity = {10.0};
  light.opening = {{{1.5, 1.5, 3}, {2.5, 1.5, 3}, {2.5, 2.5, 3}, {1.5, 2.5, 3}}};
  const BoundResult found = bound(scene, 500);
  constexpr int side = 40;
  for (std::size_t k = 0; k < scene.polygons.size(); ++k) {
    double flux = 0.0;  // each point of the opening sends to all directions alike
    for (int i = 0; i < side * side; ++i) {
      const Vec3 y(1.5 + (i % side + 0.5) / side, 1.5 + (i / side + 0.5) / side, 3.0);
      flux += 10.0 * solid_angle(y, scene.polygons[k].polygon) / (side * side);
    }
    expect_holds(found.polygons[k][0], flux / 16.0);
    EXPECT_LT(found.polygons[k][0].hi, 8.0 * flux / 16.0);
  }
}

TEST(BoundIrradiance, MoreLinksNeverWidenAnInterval) {
  BoundScene scene;
  add_box(scene, Vec3(0), Vec3(4, 5, 3));
  add_box(scene, Vec3(1, 1, 0.5), Vec3(2, 3, 1), true);
  scene.polygons[1].exitance = {10.0};
  scene.polygons[0].reflectance = {0.2};
  scene.polygons[8].reflectance = {0.8};
  one_target(scene);
  BoundResult last = bound(scene, 100);
  for (const std::size_t links : {1000u, 4000u, 6000u}) {
    const BoundResult next = bound(scene, links);
    for (std::size_t k = 0; k < scene.polygons.size(); ++k) {
      EXPECT_GE(next.polygons[k][0].lo, last.polygons[k][0].lo);
      EXPECT_LE(next.polygons[k][0].hi, last.polygons[k][0].hi);
    }
    EXPECT_LE(next.targets[0][0].width(), last.targets[0][0].width());
    EXPECT_GE(next.links, last.links);
    last = next;
  }
  EXPECT_LT(relative_width(last.targets[0][0]), 0.5);
}

/// The first polygon that a ray meets; none where it leaves the scene.
const BoundPolygon* first_hit(const BoundScene& scene, Vec3 from, const Vec3& direction,
                              const BoundPolygon* skip, bool& front, Vec3& place) {
  const BoundPolygon* hit = nullptr;
  double nearest = 1e300;
  for (const BoundPolygon& p : scene.polygons) {
    if (&p == skip) continue;
    const Plane plane = plane_of(p.polygon);
    const double slope = glm::dot(plane.n, direction);
    if (slope == 0.0) continue;
    const double t = -plane.signed_distance(from) / slope;
    if (t <= 1e-9 || t >= nearest || !contains(p.polygon, plane.n, from + t * direction)) continue;
    hit = &p;
    nearest = t;
    front = slope < 0.0;
    place = from + t * direction;
  }
  return hit;
}

/// The light on one path from a polygon.
double path(const BoundScene& scene, const BoundPolygon& start, Random& random) {
  const BoundPolygon* at = &start;
  Vec3 x = uniform_point(start.polygon, random.uniform(), random.uniform());
  double light = 0.0, weight = 1.0;
  for (int i = 0; i < 200; ++i) {
    bool front = false;
    const Vec3 direction =
        cosine_direction(normal(at->polygon), random.uniform(), random.uniform());
    at = first_hit(scene, x, direction, at, front, x);
    if (at == nullptr || !front) break;
    light += weight * at->exitance[0];
    weight *= at->reflectance[0];
    if (weight < 1e-4) break;
  }
  return light;
}

/// A room with blocks, some of them with a side left out so that light gets lost inside.
BoundScene random_room(Random& random) {
  BoundScene scene;
  add_box(scene, Vec3(0), Vec3(3, 4, 2.5));
  for (std::uint64_t i = 0, count = 1 + random.below(3); i < count; ++i) {
    const Vec3 lo =
        Vec3(0.2) + Vec3(1.8 * random.uniform(), 2.5 * random.uniform(), 1.2 * random.uniform());
    add_box(scene, lo,
            lo + Vec3(0.1) + 0.8 * Vec3(random.uniform(), random.uniform(), random.uniform()),
            true);
    if (random.uniform() < 0.3) scene.polygons.pop_back();
  }
  for (BoundPolygon& p : scene.polygons) p.reflectance = {0.8 * random.uniform()};
  scene.polygons[random.below(scene.polygons.size())].exitance = {20.0};
  scene.polygons[1].exitance = {5.0};
  return scene;
}

TEST(BoundIrradiance, HoldsThePathTracedLightOfRandomRooms) {
  Random random(21);
  int checked = 0;
  double widths = 0.0;
  for (int trial = 0; trial < 8; ++trial) {
    const BoundScene scene = random_room(random);
    const BoundResult found = bound(scene, 400);
    widths += relative_width(found.scene[0]) / 8.0;
    for (std::size_t k = 0; k < scene.polygons.size(); k += 3) {
      double sum = 0.0, squares = 0.0;
      constexpr int paths = 1200;
      for (int i = 0; i < paths; ++i) {
        const double light = path(scene, scene.polygons[k], random);
        sum += light;
        squares += light * light;
      }
      const double mean = sum / paths;
      const double sigma = std::sqrt(std::max(0.0, squares / paths - mean * mean) / paths);
      EXPECT_GE(mean, found.polygons[k][0].lo - 4.5 * sigma - 1e-6)
          << trial << ' ' << k << " closed " << found.closed_polygons << " of "
          << scene.polygons.size();
      EXPECT_LE(mean, found.polygons[k][0].hi + 4.5 * sigma + 1e-6) << trial << ' ' << k;
      ++checked;
    }
  }
  EXPECT_GT(checked, 30);
  EXPECT_LT(widths, 1.5);
}

TEST(BoundIrradiance, HoldsWhatAPanePasses) {
  // From the wall at x = 0, which emits 1, to that at x = 2, through a pane at x = 1; black walls.
  constexpr int steps = 14;
  double through = 0.0, plain = 0.0;
  for (int i = 0; i < steps * steps; ++i) {
    for (int j = 0; j < steps * steps; ++j) {
      const Vec3 x(2.0, (i % steps + 0.5) / steps, (i / steps + 0.5) / steps);
      const Vec3 y(0.0, (j % steps + 0.5) / steps, (j / steps + 0.5) / steps);
      const double kernel = point_kernel(x, Vec3(-1, 0, 0), y, Vec3(1, 0, 0));
      plain += kernel;
      through += kernel * 0.6 * pane_share(2.0 / glm::length(x - y));
    }
  }
  const double pairs = std::pow(steps, 4);
  BoundScene scene;
  add_box(scene, Vec3(0), Vec3(2, 1, 1));
  std::size_t from = 0, to = 0;
  for (std::size_t k = 0; k < scene.polygons.size(); ++k) {
    scene.polygons[k].reflectance = {0.0};
    const Vec3 n = normal(scene.polygons[k].polygon);
    if (n.x > 0.9) from = k;
    if (n.x < -0.9) to = k;
  }
  scene.polygons[from].exitance = {1.0};
  scene.polygons.push_back(
      {{{1, 0, 0}, {1, 0, 1}, {1, 1, 1}, {1, 1, 0}}, {0.0}, {0.0}, {0.6}, true});
  one_target(scene);
  const Range black = bound(scene, 3000).polygons[to][0];
  expect_holds(black, through / pairs, 1e-4);
  EXPECT_LE(black.hi, 1.05 * plain / pairs);
  // With light walls and a pane that reflects, there is more light, and what is emitted still
  // bounds it.
  for (BoundPolygon& p : scene.polygons) p.reflectance = {p.pane ? 0.2 : 0.5};
  const Range light = bound(scene, 3000).polygons[to][0];
  EXPECT_LE(light.lo, light.hi);
  EXPECT_GE(light.hi, through / pairs);
  EXPECT_LE(light.hi, 1.0 / (1.0 * 0.5) + 1e-9);
}

}  // namespace
}  // namespace enfilade
