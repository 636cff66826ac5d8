// Estimates by random rays have the mean that quadrature or the public set of form factors tells.
#include <gtest/gtest.h>

#include "base/random.hpp"
#include "geometry/form_factor.hpp"
#include "occluders/light_at.hpp"
#include "occluders/openness.hpp"
#include "unit/known_factors.hpp"
#include "unit/statistics.hpp"

namespace enfilade {
namespace {

/// A luminaire above a floor, half hidden by a board.
TEST(LightByOneRay, IsUnbiased) {
  Scene scene = testing::box_room({-3, -3, 0}, {3, 3, 3}, {0.5}, {0.0});
  Surface board;
  board.vertices = {{-0.1, -1, 1.5}, {2, -1, 1.5}, {2, 1, 1.5}, {-0.1, 1, 1.5}};
  board.reflectance = {0.0};
  board.exitance = {0.0};
  scene.surfaces.push_back(board);
  const std::vector<Cluster> clusters = testing::clusters_of(scene);
  const Occluders occluders(clusters);
  LightSource light{{0.0, 0.1, 2.8}, {1.0}};
  light.shape = {OpeningShape::rectangle, {1.2, 0.6, 0.0}};
  light.frame = LightFrame::of({0, 0, -1}, {0, 1, 0}).value();
  make_opening(light);
  const LitPlace place{{-0.3, 0.2, 0.01}, {0, 0, 1}};
  const auto is_open = [&](const Vec3& y) {  // the board's edge at x = -0.1, z = 1.5
    const double t = (1.5 - place.x.z) / (y.z - place.x.z);
    return place.x.x + t * (y.x - place.x.x) < -0.1;
  };
  double want = 0.0;
  constexpr int fine = 1200;
  for (int i = 0; i < fine; ++i) {
    for (int j = 0; j < 100; ++j) {
      const Vec3 y(1.2 * ((i + 0.5) / fine - 0.5), 0.1 + 0.6 * ((j + 0.5) / 100 - 0.5), 2.8);
      const Vec3 d = y - place.x;
      const double r = glm::length(d);
      if (is_open(y)) want += d.z / (r * r * r) / (fine * 100.0);
    }
  }
  Random random(1);
  testing::Samples samples;
  for (int i = 0; i < 40000; ++i) {
    const double r1 = random.uniform(), r2 = random.uniform();
    samples.add(light_by_one_ray(light, place, occluders, r1, r2).irradiance);
  }
  EXPECT_GT(samples.variance(), 0.0);
  EXPECT_TRUE(testing::has_mean(samples, want, 1, 1e-3 * want));
}

/// What ends on a front side that is still dark may count later; what ends on backs and nowhere
/// never will.
TEST(EnclosedShare, TellsWhatMayStillCount) {
  const Scene scene = testing::box_room({0, 0, 0}, {3, 2, 1}, {0.5}, {1.0});
  const std::vector<Cluster> clusters = testing::clusters_of(scene);
  const Occluders occluders(clusters);
  const ClusterState state(clusters[0], scene, Basis::constant);
  WorkCount work;
  const auto found = [&](const EndsRay& ends) {
    return enclosed_share(state, state.patches().node(0), 8, occluders, ends, work);
  };
  const EnclosedShare all = found([](const PolygonRef&) { return true; });
  EXPECT_EQ(all.pending, 0.0);
  EXPECT_EQ(all.share, 1.0);
  const EnclosedShare but_one = found([](const PolygonRef& p) { return p.cluster.index() != 1; });
  EXPECT_GT(but_one.pending, 0.05);
  EXPECT_NEAR(but_one.share + but_one.pending, 1.0, 1e-12);
}

/// The share of a receiver's hemisphere that ends on the shooter's front is its form factor. The
/// rays are stratified: one estimate is a sample, and patches of one polygon have seeds of their
/// own.
TEST(EnclosedShare, HasTheKnownFactorsForMeans) {
  int tests = 0;
  for (const testing::KnownFactor& known : testing::known_factors())
    tests += known.from_point() || known.factor < 1e-3 ? 0 : 1;
  for (const testing::KnownFactor& known : testing::known_factors()) {
    if (known.from_point() || known.factor < 1e-3) continue;
    const Scene scene = testing::scene_of(known);
    const std::vector<Cluster> clusters = testing::clusters_of(scene);
    const Occluders occluders(clusters);
    ClusterState receiving(clusters.back(), scene, Basis::constant);
    PatchForest& patches = receiving.patches();
    // Quadrilaterals stay such: points in quarters are uniform on rectangles alone.
    if (patches.node(0).shape.vertices.size() != 4) continue;
    for (std::size_t i = 0; i < patches.size() && patches.size() < 200; ++i) patches.subdivide(i);
    WorkCount work;
    testing::Samples ratio;
    double mean = 0.0, area = 0.0, variance = 0.0;
    for (std::size_t i = 0; i < patches.size(); ++i) {
      const PatchNode& node = patches.node(i);
      if (!node.leaf()) continue;
      const double share = enclosed_share(
                               receiving, node, 4, occluders,
                               [](const PolygonRef& p) { return p.cluster.index() == 0; }, work)
                               .share;
      mean += node.shape.area_m2 * share;
      area += node.shape.area_m2;
      // Of 64 independent rays; stratified ones vary less.
      variance +=
          node.shape.area_m2 * node.shape.area_m2 * std::max(share * (1.0 - share), 1e-3) / 64.0;
    }
    const double p_limit = testing::sidak(tests);
    const boost::math::normal_distribution<> normal;
    const double reach = boost::math::quantile(boost::math::complement(normal, 0.5 * p_limit));
    EXPECT_NEAR(mean / area, known.factor, reach * std::sqrt(variance) / area + 2e-3 * known.factor)
        << known.name;
  }
}

}  // namespace
}  // namespace enfilade
