// The random parts of a point's gather against known form factors: t-tests over independent seeds.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "final_gather/emitter_picker.hpp"
#include "final_gather/emitter_sampler.hpp"
#include "final_gather/point_gather.hpp"
#include "geometry/form_factor.hpp"
#include "geometry/sampling.hpp"
#include "unit/gather/box_room.hpp"
#include "unit/known_factors.hpp"
#include "unit/statistics.hpp"

namespace enfilade {
namespace {

constexpr std::uint32_t in_air = RayScene::no_polygon;

/// Of many polygons each a cluster of its own.
struct Field {
  Scene scene;
  std::vector<Cluster> clusters;
  Occluders occluders;
  std::vector<ClusterState> states;

  explicit Field(Scene made)
      : scene(std::move(made)), clusters(testing::clusters_of(scene)), occluders(clusters) {
    for (const Cluster& cluster : clusters) states.emplace_back(cluster, scene, Basis::linear);
  }
};

Surface black(const Polygon& corners, double exitance) {
  Surface surface;
  surface.vertices = corners;
  surface.reflectance = {0.0};
  surface.exitance = {exitance};
  return surface;
}

/// Lamps of unlike size and brightness in a black room: which is picked is random, not what it
/// brings. One of them is behind a board, one half, and small for its distance.
TEST(EmitterPicker, PickedRaysAreUnbiased) {
  Scene scene = testing::box_room({0, 0, 0}, {6, 6, 3}, {0.0}, {0.0});
  const auto lamp = [&](double x, double y, double size, double exitance) {
    scene.surfaces.push_back(
        black({{x, y, 2.9}, {x, y + size, 2.9}, {x + size, y + size, 2.9}, {x + size, y, 2.9}},
              exitance));
    return scene.surfaces.back().vertices;
  };
  const Polygon open_1 = lamp(1, 1, 1.0, 20.0), open_2 = lamp(4, 1, 0.3, 300.0);
  lamp(4.5, 4.5, 0.5, 50.0);
  const Polygon half = lamp(3.0, 3.0, 0.1, 500.0);
  const Vec3 p(2.0, 2.0, 0.5), up(0, 0, 1);
  const auto board = [&](double x0, double y0, double x1, double y1) {
    scene.surfaces.push_back(
        black({{x0, y0, 2.0}, {x1, y0, 2.0}, {x1, y1, 2.0}, {x0, y1, 2.0}}, 0));
  };
  board(3.2, 3.2, 5.0, 5.0);
  // Of `half` what lies beyond x = 3.05 is hidden: the line there crosses z = 2 at x = 2.65625.
  board(2.65625, 2.5, 2.9, 2.9);
  const Field field(scene);
  const EmitterSampler sampler(field.states, field.occluders);
  Polygon seen = half;
  for (Vec3& corner : seen) corner.x = std::min(corner.x, 3.05);
  const double want = 20.0 * point_to_polygon(p, up, open_1) +
                      300.0 * point_to_polygon(p, up, open_2) +
                      500.0 * point_to_polygon(p, up, seen);
  const EmitterPicker picker(sampler.bright(), {}, field.occluders, 1);
  const std::vector<double> weights = picker.weights(p);
  Random random(1);
  testing::Samples samples;
  for (int i = 0; i < 40000; ++i) {
    Spectrum light{0.0};
    picker.add_picked({p, up, in_air, RayStart::in_air}, weights, random, std::vector<double>{1.0},
                      light);
    samples.add(light[0]);
  }
  EXPECT_GT(samples.variance(), 0.0);
  // Over so small a lamp the kernel varies by 1%, of a tenth of the light.
  EXPECT_TRUE(testing::has_mean(samples, want, 1, 1e-3 * want));
}

/// The same at a place on a polygon, of which rays from the lamps have shown what lights it: of 40
/// lamps and as many lights, all but one of each behind a wall, these are picked, and few others.
TEST(EmitterPicker, PicksOnAPolygonWhatLightsIt) {
  Scene scene = testing::box_room({0, 0, 0}, {40, 6, 3}, {0.0}, {0.0});
  std::vector<Polygon> lamps;
  std::vector<LightSource> lights;
  for (int i = 0; i < 40; ++i) {
    const double x = i + 0.3;
    lamps.push_back({{x, 3, 2.9}, {x, 3.3, 2.9}, {x + 0.3, 3.3, 2.9}, {x + 0.3, 3, 2.9}});
    scene.surfaces.push_back(black(lamps.back(), 100.0));
    lights.push_back({.p = Vec3(x, 2.0, 2.5), .intensity = {5.0}});
    scene.surfaces.push_back(
        black({{i + 1.0, 0, 0}, {i + 1.0, 6, 0}, {i + 1.0, 6, 3}, {i + 1.0, 0, 3}}, 0.0));
    scene.surfaces.push_back(
        black({{i + 0.1, 1, 0.1}, {i + 0.9, 1, 0.1}, {i + 0.9, 5, 0.1}, {i + 0.1, 5, 0.1}}, 0.0));
  }
  const Field field(scene);
  const EmitterSampler sampler(field.states, field.occluders);
  ASSERT_EQ(sampler.bright().size(), 40u);
  const EmitterPicker picker(sampler.bright(), lights, field.occluders, 1);
  const Vec3 on(20.6, 2.4, 0.1), up(0, 0, 1);
  const RayHit board = field.occluders.rays().closest(on + up, -up);
  ASSERT_TRUE(board.any());
  const Vec3 p = on + 2.0 * field.occluders.rays().epsilon_m() * up;
  const Vec3 d = lights[20].p - p;
  const double want =
      100.0 * point_to_polygon(p, up, lamps[20]) + 5.0 * d.z / std::pow(glm::length(d), 3.0);
  const std::vector<double> weights = picker.weights(Vec3(5.0, 3.0, 1.0));
  Random random(1);
  testing::Samples samples;
  for (int i = 0; i < 20000; ++i) {
    Spectrum light{0.0};
    picker.add_picked({p, up, board.polygon, RayStart::in_air}, weights, random,
                      std::vector<double>{1.0}, light);
    samples.add(light[0]);
  }
  EXPECT_TRUE(testing::has_mean(samples, want, 1, 1e-3 * want));
  // A pick among all 80 alike would have a variance of about 80 times the square of the mean.
  EXPECT_LT(samples.variance(), want * want);
}

/// A board beside a lamp is bright, but at one end alone: a place below the other end sees what is
/// there, not the board's mean light. Held against quadrature over the board's own patches.
TEST(EmitterPicker, ABrightPolygonsLightIsThatOfItsPatches) {
  Scene scene = testing::box_room({0, 0, 0}, {12, 6, 3}, {0.1}, {0.0});
  scene.surfaces.push_back(
      black({{0.9, 2.9, 2.9}, {0.9, 3.1, 2.9}, {1.1, 3.1, 2.9}, {1.1, 2.9, 2.9}}, 5000.0));
  scene.surfaces.push_back(
      black({{0.5, 2.6, 2.6}, {2.5, 2.6, 2.6}, {2.5, 3.4, 2.6}, {0.5, 3.4, 2.6}}, 0.0));
  const std::size_t board = scene.surfaces.size() - 1;
  scene.surfaces[board].reflectance = {0.8};
  const testing::Solved solved(scene, Basis::linear, 1e-4);
  const EmitterSampler sampler(solved.states, solved.occluders);
  ASSERT_EQ(sampler.bright().size(), 2u);
  const EmitterPicker picker(sampler.bright(), {}, solved.occluders, 1);
  const Vec3 p(2.4, 3.0, 2.8), down(0, 0, -1);
  const PatchForest& patches = solved.states[board].patches();
  constexpr int side = 600;
  double want = 0.0, mean = 0.0;
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      const Vec3 y(0.5 + 2.0 * (i + 0.5) / side, 2.6 + 0.8 * (j + 0.5) / side, 2.6);
      const double kernel = point_kernel(p, down, y, {0, 0, 1}) * 2.0 * 0.8 / (side * side);
      std::array<double, 1> radiosity{};
      patches.evaluate(true, 0, y, radiosity);
      want += kernel * radiosity[0];
      mean += kernel * patches.radiosity(0)[0];
    }
  }
  ASSERT_LT(want, 0.5 * mean);
  const std::vector<double> weights = picker.weights(p);
  Random random(3);
  testing::Samples samples;
  for (int i = 0; i < 40000; ++i) {
    Spectrum light{0.0};
    picker.add_picked({p, down, in_air, RayStart::in_air}, weights, random,
                      std::vector<double>{1.0}, light);
    samples.add(light[0]);
  }
  EXPECT_TRUE(testing::has_mean(samples, want, 1, 1e-3 * want));
}

/// Of a polygon that more stands before than is cut out, the nodes before which less stands are
/// found, each as it is seen; the others are left out.
TEST(VisibleNodes, FindSomeOfAPolygonBehindMany) {
  Scene scene = testing::box_room({0, 0, 0}, {6, 6, 3}, {0.5}, {0.0});
  scene.surfaces.push_back(
      black({{1, 1, 2.5}, {1, 1.3, 2.5}, {1.3, 1.3, 2.5}, {1.3, 1, 2.5}}, 1000.0));
  for (int i = 0; i < 30; ++i) {
    const double x = 3.5 + 0.05 * i;
    scene.surfaces.push_back(
        black({{x, 0.5, 2.5}, {x + 0.02, 0.5, 2.5}, {x + 0.02, 5.5, 2.5}, {x, 5.5, 2.5}}, 0.0));
  }
  const testing::Solved solved(scene, Basis::linear, 1e-3);
  const Vec3 p(3.0, 3.0, 0.2), up(0, 0, 1);
  const RayHit ceiling = solved.occluders.rays().closest({5.5, 5.9, 2.0}, up);
  const PolygonRef ref = solved.occluders.local(ceiling.polygon);
  const PatchForest& forest = solved.states[ref.cluster.index()].patches();
  VisibleNodes visible(solved.occluders);
  std::vector<VisibleNode> found;
  EXPECT_FALSE(visible.find(p, up, in_air, ref.cluster, forest, ref.polygon, 1e-3, found));
  ASSERT_TRUE(visible.find_some(p, up, in_air, ref.cluster, forest, ref.polygon, 1e-3, 0.0, found));
  Random random(2);
  for (const VisibleNode& node : found) {
    const PatchShape& shape = forest.node(node.node).shape;
    const Polygon corners = corners_of(forest.frames()[ref.polygon], shape);
    const double whole = point_to_polygon(p, up, corners);
    ASSERT_LE(node.factor, whole * (1.0 + 1e-9));
    int open = 0;
    constexpr int rays = 400;
    for (int i = 0; i < rays; ++i) {
      const Vec2 y = uniform_point({shape.vertices.data(), shape.vertices.size()}, shape.area_m2,
                                   (i + random.uniform()) / rays, random.uniform());
      open += solved.occluders.rays().occluded(p, forest.frames()[ref.polygon].at(y), in_air,
                                               ceiling.polygon)
                  ? 0
                  : 1;
    }
    EXPECT_NEAR(node.factor / whole, open / double{rays}, 0.13);
  }
}

/// Polygons that are no brighter than most, behind any number of occluders: what is not integrated
/// in closed form is left to the hemisphere's rays. Their mean is the truth, and the error that
/// they tell is that of the mean.
TEST(PointGather, RaysOfTheHemisphereAreUnbiased) {
  constexpr int seeds = 300;
  int noisy = 0, points = 0;
  std::vector<testing::KnownFactor> known = testing::known_factors();
  std::erase_if(known, [](const testing::KnownFactor& k) {
    return !k.from_point() || k.factor < 1e-2 || k.occluders.empty();
  });
  for (const testing::KnownFactor& one : known) {
    Scene scene = testing::scene_of(one);
    scene.surfaces.pop_back();  // the plate that would make the shooter a bright emitter
    const Field field(scene);
    testing::Samples light, squares;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      const PointGather gather(field.states, {}, field.occluders,
                               {.rays = 16, .noise = 0.0, .seed = seed});
      const PointIrradiance found = gather.at(one.x, one.n);
      light.add(found.irradiance[0]);
      const double off = found.irradiance[0] - one.factor;
      squares.add(found.noise[0] * found.noise[0] - off * off);
    }
    ++points;
    EXPECT_TRUE(
        testing::has_mean(light, one.factor, static_cast<int>(known.size()), 2e-4 * one.factor))
        << one.name;
    const double variance = light.variance();
    if (variance < 1e-8) continue;
    ++noisy;
    // Neighbouring strata differ by more than noise: the estimate errs on the safe side.
    EXPECT_GT(squares.mean(), -0.35 * variance) << one.name;
    EXPECT_LT(squares.mean(), 2.0 * variance) << one.name;
  }
  EXPECT_GE(points, 10);
  EXPECT_GE(noisy, 2);
}

/// Parts that are sampled by rays in find_by_parts(): unbiased where the parts are small.
TEST(VisibleNodes, RaysOfPartsAreUnbiased) {
  int sampled = 0;
  for (const testing::KnownFactor& known : testing::known_factors()) {
    if (!known.from_point() || known.factor < 1e-2 || known.occluders.size() < 17) continue;
    const Field field(testing::scene_of(known));
    VisibleNodes visible(field.occluders);
    testing::Samples factor;
    double variance = 0.0;
    constexpr int trials = 400;
    for (std::uint64_t seed = 1; seed <= trials; ++seed) {
      Random random(seed);
      VisibleNode node{0};
      variance += visible.find_by_parts(known.x, known.n, in_air, ClusterId(0u),
                                        field.states[0].patches(), 0, 1e9, 0.05, random, node) /
                  trials;
      factor.add(node.factor);
    }
    if (variance == 0.0) continue;
    ++sampled;
    // Over a part of a twentieth of the hemisphere the kernel varies little.
    EXPECT_TRUE(testing::has_mean(factor, known.factor, 8, 0.02 * known.factor)) << known.name;
    EXPECT_GT(variance, 0.5 * factor.variance()) << known.name;
  }
  EXPECT_GE(sampled, 1);
}

}  // namespace
}  // namespace enfilade
