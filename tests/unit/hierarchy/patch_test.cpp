#include "hierarchy/patch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "links/link_estimate.hpp"
#include "unit/gather/box_room.hpp"

namespace enfilade {
namespace {

const PatchOutline pentagon{{0, 0}, {3, 0.2}, {3.5, 1.5}, {1.7, 2.4}, {-0.3, 1.1}};

/// Integral of f over a polygon by a fine fan of midpoint triangles: an independent answer for
/// moments.
template <class F>
double integral(const PatchOutline& p, F f) {
  double sum = 0.0;
  const int n = 400;
  for (std::size_t i = 2; i < p.size(); ++i) {
    const Vec2 a = p[i - 1] - p[0], b = p[i] - p[0];
    const double area = 0.5 * (a.x * b.y - a.y * b.x) / (n * n);
    for (int j = 0; j < n; ++j) {
      for (int k = 0; k < n - j; ++k) {
        sum += area * f(p[0] + a * ((j + 1.0 / 3) / n) + b * ((k + 1.0 / 3) / n));
        if (k < n - j - 1)
          sum += area * f(p[0] + a * ((j + 2.0 / 3) / n) + b * ((k + 2.0 / 3) / n));
      }
    }
  }
  return sum;
}

TEST(PatchShape, MomentsMatchNumericalIntegrals) {
  const PatchShape s = PatchShape::from(pentagon);
  EXPECT_NEAR(s.area_m2, integral(pentagon, [](Vec2) { return 1.0; }), 1e-9);
  EXPECT_NEAR(s.centroid.x, integral(pentagon, [](Vec2 p) { return p.x; }) / s.area_m2, 1e-6);
  const Vec2 c = s.centroid;
  EXPECT_NEAR(s.cxx,
              integral(pentagon, [&](Vec2 p) { return (p.x - c.x) * (p.x - c.x); }) / s.area_m2,
              1e-5);
  EXPECT_NEAR(s.cxy,
              integral(pentagon, [&](Vec2 p) { return (p.x - c.x) * (p.y - c.y); }) / s.area_m2,
              1e-5);
}

TEST(PatchShape, QuadratureIsExactForQuadratics) {
  const PatchShape s = PatchShape::from(pentagon);
  const auto f = [](Vec2 p) {
    return 1.0 + p.x - 2.0 * p.y + p.x * p.x + 0.5 * p.x * p.y - p.y * p.y;
  };
  double mean = 0.0;
  for (const Vec2& p : s.quadrature()) mean += 0.25 * f(p);
  EXPECT_NEAR(mean, integral(pentagon, f) / s.area_m2, 1e-5);
}

TEST(PatchShape, TheLongAxisTurnsWithTheShape) {
  for (int degrees = -85; degrees <= 90; degrees += 5) {
    const double angle = degrees * std::numbers::pi / 180.0;
    const Vec2 along{std::cos(angle), std::sin(angle)}, across{-along.y, along.x};
    const PatchShape s = PatchShape::from({Vec2(7, 3), Vec2(7, 3) + 3.0 * along,
                                           Vec2(7, 3) + 3.0 * along + across, Vec2(7, 3) + across});
    EXPECT_NEAR(std::abs(glm::dot(s.long_axis(), along)), 1.0, 1e-12) << degrees;
    EXPECT_NEAR(glm::length(s.long_axis()), 1.0, 1e-12) << degrees;
  }
}

TEST(PatchShape, HalvesCoverTheWhole) {
  PatchShape s = PatchShape::from(pentagon);
  for (int depth = 0; depth < 12; ++depth) {
    const auto [low, high] = s.halves(s.cut({}));
    EXPECT_NEAR(low.area_m2 + high.area_m2, s.area_m2, 1e-12 * s.area_m2);
    EXPECT_GT(low.area_m2, 0.2 * s.area_m2);
    EXPECT_GT(high.area_m2, 0.2 * s.area_m2);
    s = high;
  }
}

TEST(PatchShape, IsCutAlongTheLineThatPartsItBest) {
  const PatchShape s = PatchShape::from({{0, 0}, {4, 0}, {4, 2}, {0, 2}});
  const MeshLine across{{1, 0}, {1, 2}}, short_one{{2, 0}, {2, 0.5}},
      at_the_rim{{0.25, 0}, {0.25, 2}};
  const auto at_x = [](const PatchCut& cut) { return cut.at / cut.axis.x; };
  const std::vector<MeshLine> all{short_one, at_the_rim, across};
  EXPECT_DOUBLE_EQ(at_x(s.cut(all)), 1.0);
  EXPECT_DOUBLE_EQ(at_x(s.cut(std::vector<MeshLine>{short_one, at_the_rim})), 2.0);
  // What is left for the part before it, is cut along the line at the rim.
  const auto [low, high] = s.halves(s.cut(all));
  const PatchShape& left = low.centroid.x < high.centroid.x ? low : high;
  EXPECT_DOUBLE_EQ(left.area_m2, 2.0);
  EXPECT_DOUBLE_EQ(at_x(left.cut(all)), 0.25);
}

/// For every inner node: mean of its children = its own value, and an affine light survives the
/// round trip.
TEST(PatchForest, PushPullIsConsistentAndExactForAffineLight) {
  const Scene scene = testing::box_room({0, 0, 0}, {3, 2, 1}, {0.5, 0.9}, {1.0, 0.0});
  for (const Basis basis : {Basis::constant, Basis::linear}) {
    ClusterState state(testing::clusters_of(scene)[0], scene, basis);
    PatchForest& f = state.patches();
    const std::size_t child = f.subdivide(0);
    f.subdivide(child);
    f.subdivide(child + 1);
    const auto terms = static_cast<std::size_t>(f.terms());
    std::vector<double> gathered(f.size() * 2 * terms, 0.0);
    gathered[0] = 2.0;  // band 0 at the polygon
    if (terms == 3) {
      gathered[1] = 0.7;
      gathered[2] = -0.3;
    }
    gathered[(child * 2 + 1) * terms] = 5.0;  // band 1 at one child only
    f.push_pull(gathered);
    for (std::size_t n = 0; n < f.size(); ++n) {
      if (f.node(n).leaf()) continue;
      for (std::size_t b = 0; b < 2; ++b) {
        double mean = 0.0;
        for (std::size_t c = 0; c < 2; ++c) {
          const std::size_t k = static_cast<std::size_t>(f.node(n).first_child) + c;
          mean += f.node(k).shape.area_m2 * f.radiosity(k)[b * terms];
        }
        EXPECT_NEAR(mean / f.node(n).shape.area_m2, f.radiosity(n)[b * terms], 1e-12);
      }
    }
    EXPECT_NEAR(f.irradiance(0)[0], 2.0, 1e-12);
    EXPECT_NEAR(f.radiosity(0)[0], 1.0 + 0.5 * 2.0, 1e-12);
    EXPECT_NEAR(f.irradiance(0)[terms], 2.5, 1e-12);  // half of it has 5
    if (terms == 3) {
      EXPECT_NEAR(f.irradiance(0)[1], 0.7, 1e-12);
    }
    EXPECT_GT(f.deviation(0), 0.1);  // the jump between the halves
    EXPECT_NEAR(f.deviation(child), 0.0, 1e-7);
  }
}

TEST(PatchForest, AGroupSendsTheMeanOfItsPolygonsByArea) {
  Scene scene = testing::box_room({0, 0, 0}, {3, 2, 1}, {0.5, 0.2}, {1.0, 0.0});
  testing::add_block(scene, {1, 0.5, 0}, {1.5, 1, 0.6}, {0.4, 0.4}, {0.0, 1.0});
  scene.surfaces.back().exitance = {4.0, 2.0};
  const ClusterState state(testing::clusters_of(scene).back(), scene, Basis::linear);
  const PatchForest& f = state.patches();
  ASSERT_TRUE(f.root().is_group());
  double area = 0.0, power[2] = {0.0, 0.0};
  for (std::size_t k = 0; k < f.polygons(); ++k) {
    area += f.node(k).shape.area_m2;
    for (std::size_t b = 0; b < 2; ++b)
      power[b] += f.node(k).shape.area_m2 * f.frames()[k].exitance[b];
  }
  const ClusterState copy(state.bytes_of(Section::geometry), state.bytes_of(Section::patches), {});
  for (std::size_t b = 0; b < 2; ++b) {
    EXPECT_NEAR(f.exitance(f.root(), b), power[b] / area, 1e-12);
    EXPECT_EQ(copy.patches().exitance(f.root(), b), f.exitance(f.root(), b));
  }
  EXPECT_EQ(f.exitance({0, 0b101}, 0), f.frames()[0].exitance[0]);
}

TEST(NodeLight, IsThatOfTheSideOfALink) {
  const Scene scene = testing::box_room({0, 0, 0}, {3, 2, 1}, {0.5, 0.9}, {1.0, 0.0});
  ClusterState state(testing::clusters_of(scene)[0], scene, Basis::linear);
  PatchForest& f = state.patches();
  f.subdivide(f.subdivide(0));
  std::vector<double> gathered(f.size() * 6, 0.0);
  gathered[0] = 2.0;
  gathered[1] = 0.7;
  gathered[5] = -0.3;
  f.push_pull(gathered);
  for (const std::uint32_t path : {1u, 2u, 3u, 4u, 5u, 6u, 13u, 21u}) {  // 6, 13, 21: not made
    const NodeLight light = NodeLight::of(f, {0, path});
    const LinkSide side = LinkSide::of(f, ClusterId(0u), {0, path});
    EXPECT_EQ(light.light, side.light) << path;
    EXPECT_EQ(light.variation, side.variation) << path;
    EXPECT_GT(light.variation, 0.0) << path;
  }
  EXPECT_GT(NodeLight::of(f, {0, 13}).light, 1.0);
  EXPECT_NE(NodeLight::of(f, {0, 13}).light, NodeLight::of(f, {0, 3}).light);
}

TEST(PatchForest, FindsTheDeepestAncestorThatWasMade) {
  const Scene scene = testing::box_room({0, 0, 0}, {3, 2, 1}, {0.5}, {1.0});
  ClusterState state(testing::clusters_of(scene)[0], scene, Basis::constant);
  PatchForest& f = state.patches();
  const std::size_t child = f.subdivide(0);
  EXPECT_EQ(f.find({0, 1}), 0u);
  EXPECT_EQ(f.find({0, 0b11}), child + 1);
  EXPECT_EQ(f.find({0, 0b1101}), child + 1);
}

}  // namespace
}  // namespace enfilade
