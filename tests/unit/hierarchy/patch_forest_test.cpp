#include "hierarchy/patch_forest.hpp"

#include <gtest/gtest.h>

#include "unit/gather/box_room.hpp"

namespace enfilade {
namespace {

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

/// The light of a group, not only what it emits: by area, with the deviation of its polygons.
TEST(PatchForest, AGroupHasTheLightOfItsPolygonsByArea) {
  Scene scene = testing::box_room({0, 0, 0}, {3, 2, 1}, {0.5}, {0.0});
  testing::add_block(scene, {1, 0.5, 0}, {1.5, 1, 3.0}, {1.0}, {0.0});
  ClusterState state(testing::clusters_of(scene).back(), scene, Basis::constant);
  PatchForest& f = state.patches();
  std::vector<double> irradiance;
  double area = 0.0, power = 0.0, square = 0.0;
  for (std::size_t k = 0; k < f.polygons(); ++k) {
    irradiance.push_back(1.0 + static_cast<double>(k * k));
    const double m2 = f.node(k).shape.area_m2;
    area += m2;
    power += m2 * irradiance.back();
    square += m2 * irradiance.back() * irradiance.back();
  }
  f.push_pull(irradiance);
  const double mean = power / area;
  EXPECT_NEAR(f.group_radiosity(f.root().group())[0], mean, 1e-9);
  EXPECT_NEAR(f.group_deviation(f.root().group()), std::sqrt(square / area - mean * mean), 1e-9);
}

/// New patches start with their parent's affine light.
TEST(PatchForest, HalvesBeginWithTheLightOfTheWhole) {
  const Scene scene = testing::box_room({0, 0, 0}, {3, 2, 1}, {0.5}, {1.0});
  ClusterState state(testing::clusters_of(scene)[0], scene, Basis::linear);
  PatchForest& f = state.patches();
  const std::vector<double> light{5.0, 0.7, -0.4};
  for (const std::span<double> values : {f.radiosity(0), f.irradiance(0)})
    std::copy(light.begin(), light.end(), values.begin());
  std::size_t leaf = 0;
  for (int depth = 0; depth < 3; ++depth) {
    const std::size_t child = f.subdivide(leaf);
    for (const std::size_t c : {child, child + 1}) {
      const Vec2 d = f.node(c).shape.centroid - f.node(0).shape.centroid;
      for (const std::span<const double> values : {f.radiosity(c), f.irradiance(c)}) {
        EXPECT_NEAR(values[0], 5.0 + 0.7 * d.x - 0.4 * d.y, 1e-12);
        EXPECT_EQ(values[1], 0.7);
        EXPECT_EQ(values[2], -0.4);
      }
    }
    leaf = child + 1;
  }
}

/// One more lit polygon in view: only what may have grown is measured anew.
TEST(PatchForest, ForgetsEnclosedSharesThatAreNotSettled) {
  const Scene scene = testing::box_room({0, 0, 0}, {3, 2, 1}, {0.5}, {1.0});
  ClusterState state(testing::clusters_of(scene)[0], scene, Basis::constant);
  PatchForest& f = state.patches();
  const std::size_t first = f.subdivide(0), second = first + 1;
  EXPECT_LT(f.enclosed_share(first), 0.0f);
  f.forget_enclosed_shares_below(10);
  f.set_enclosed_share(first, 0.5f, true);
  f.set_enclosed_share(second, 0.25f, false);
  f.forget_enclosed_shares_below(10);
  EXPECT_EQ(f.enclosed_share(second), 0.25f);
  const ClusterState read(state.bytes_of(Section::geometry), state.bytes_of(Section::patches), {});
  EXPECT_TRUE(read.patches().enclosed_share_settled(first));
  EXPECT_FALSE(read.patches().enclosed_share_settled(second));
  f.forget_enclosed_shares_below(11);
  EXPECT_EQ(f.enclosed_share(first), 0.5f);
  EXPECT_LT(f.enclosed_share(second), 0.0f);
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
