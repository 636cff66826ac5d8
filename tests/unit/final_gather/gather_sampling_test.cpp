// The random parts of a point's gather against known form factors: t-tests over independent seeds.
#include <gtest/gtest.h>

#include "final_gather/emitter_sampler.hpp"
#include "final_gather/point_gather.hpp"
#include "geometry/form_factor.hpp"
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
TEST(EmitterSampler, PickedRaysAreUnbiased) {
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
  const std::vector<double> weights = sampler.pick_weights(p);
  Random random(1);
  testing::Samples samples;
  for (int i = 0; i < 40000; ++i) {
    Spectrum light{0.0};
    sampler.add_picked(p, up, in_air, weights, random, std::vector<double>{1.0}, light);
    samples.add(light[0]);
  }
  EXPECT_GT(samples.variance(), 0.0);
  // Over so small a lamp the kernel varies by 1%, of a tenth of the light.
  EXPECT_TRUE(testing::has_mean(samples, want, 1, 1e-3 * want));
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
