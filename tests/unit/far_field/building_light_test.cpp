#include "far_field/building_light.hpp"

#include <gtest/gtest.h>

#include "unit/far_field/panels.hpp"

namespace enfilade {
namespace {

using testing::mixed_panels;
using testing::Panels;

const Vec3 up(0, 0, 1), down(0, 0, -1);

/// What the panels that face up emit: areas 1, 2, 3, 4 with exitances 1, 2, 3, 4.
constexpr double sent_up = 30.0;
/// The panels that face down: 1 m2 each, exitances 0, 10, 20, 30.
constexpr double sent_down = 60.0;

struct Light {
  Panels panels{mixed_panels()};
  BuildingTree tree{panels.clusters};
  BuildingLight light{tree, panels.scene, panels.clusters};

  /// The cluster's state with radiosity b.
  ClusterLight with_radiosity(ClusterId cluster, double b) {
    ClusterState state(panels.clusters[cluster.index()], panels.scene, Basis::constant);
    state.patches().radiosity(0)[0] = b;
    return light_of(state);
  }
};

TEST(BuildingLight, TheRootSendsWhatItsPolygonsSend) {
  const Light all;
  const std::uint32_t root = BuildingTree::root;
  EXPECT_NEAR(all.light.intensity(root, up), sent_up, 1e-9);
  EXPECT_NEAR(all.light.intensity(root, down), sent_down, 1e-9);
  EXPECT_NEAR(all.light.intensity(root, {1, 0, 0}), 4 * 2 * 0.5, 1e-9);
  EXPECT_NEAR(all.light.intensity(root, {-1, 0, 0}), 0.0, 1e-9);
  EXPECT_NEAR(all.light.power(root), sent_up + sent_down + 4.0, 1e-9);
  EXPECT_NEAR(all.light.radiosity(root, up), sent_up / 10.0, 1e-9);
  EXPECT_NEAR(all.light.emitted(root, 0), (sent_up + sent_down + 4.0) / (10.0 + 4.0 + 8.0), 1e-9);
  EXPECT_EQ(all.light.most(root), 30.0);
  EXPECT_EQ(all.light.lit_polygons(root), 11.0);  // one panel emits nothing
  EXPECT_EQ(all.light.reflected(root, 0, up), 0.0);
}

TEST(BuildingLight, ACellIsAsBrightAsItsBrightestFace) {
  const Light all;
  EXPECT_NEAR(all.light.brightest(BuildingTree::root), sent_down / 4.0, 1e-9);
  EXPECT_NEAR(all.light.brightest(all.tree.leaf_of(ClusterId(2u))), 0.5, 1e-9);
  Panels two_cells{mixed_panels()};
  two_cells.clusters[10].cell = CellId(1u);  // 1 m2, faces down, emits 30
  const BuildingTree tree(two_cells.clusters);
  const BuildingLight light(tree, two_cells.scene, two_cells.clusters);
  EXPECT_NEAR(light.brightest(BuildingTree::root), 30.0, 1e-9);
}

TEST(BuildingLight, SetAndSumReachTheRoot) {
  Light all;
  const ClusterId first(0u);  // faces up, 1 m2, emits 1
  all.light.set(first, all.with_radiosity(first, 6.0));
  all.light.sum();
  const std::uint32_t root = BuildingTree::root, leaf = all.tree.leaf_of(first);
  EXPECT_NEAR(all.light.intensity(leaf, up), 6.0, 1e-9);
  EXPECT_NEAR(all.light.intensity(root, up), sent_up + 5.0, 1e-9);
  EXPECT_NEAR(all.light.intensity(root, down), sent_down, 1e-9);
  EXPECT_NEAR(all.light.reflected_power(root, 0), 5.0, 1e-9);
  EXPECT_NEAR(all.light.reflected(leaf, 0, up), 5.0, 1e-9);
  EXPECT_NEAR(all.light.emitted(leaf, 0), 1.0, 1e-9);  // stays
  ASSERT_EQ(all.light.polygons(first).size(), 1u);
  EXPECT_NEAR(all.light.polygons(first)[0].power, 6.0, 1e-5);
  EXPECT_NEAR(all.light.polygons(first)[0].emitted, 1.0, 1e-5);
}

TEST(BuildingLight, CorrectionScalesWhatIsReflectedAlone) {
  Light all;
  const ClusterId first(0u), emitter(3u);
  all.light.set(first, all.with_radiosity(first, 6.0));
  const std::vector<double> change{0.4};
  all.light.correct(first, change);
  all.light.correct(emitter, change);  // reflects nothing
  all.light.sum();
  const std::uint32_t leaf = all.tree.leaf_of(first);
  EXPECT_NEAR(all.light.intensity(leaf, up), 1.0 + 1.4 * 5.0, 1e-9);
  EXPECT_NEAR(all.light.reflected_power(leaf, 0), 1.4 * 5.0, 1e-9);
  EXPECT_NEAR(all.light.emitted(leaf, 0), 1.0, 1e-9);
  EXPECT_NEAR(all.light.intensity(BuildingTree::root, up), sent_up + 1.4 * 5.0, 1e-9);
}

TEST(BuildingLight, DeviationIsThatOfTheRadiosities) {
  const std::vector<testing::Panel> two{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1.0},
                                        {{5, 0, 0}, {3, 0, 0}, {0, 1, 0}, 5.0}};
  const Panels panels(two);
  const BuildingTree tree(panels.clusters);
  const BuildingLight light(tree, panels.scene, panels.clusters);
  // Mean 4; squares (9 * 1 + 1 * 3) / 4 = 3.
  EXPECT_NEAR(light.deviation(BuildingTree::root), std::sqrt(3.0), 1e-9);
  EXPECT_NEAR(light.deviation(tree.leaf_of(ClusterId(1u))), 0.0, 1e-9);
}

TEST(BuildingLight, TheWorstBandCounts) {
  Panels panels(mixed_panels());
  panels.scene.bands = 2;
  for (Surface& surface : panels.scene.surfaces) {
    surface.reflectance = {0.5, 0.5};
    surface.exitance = {surface.exitance[0], 2.0 * surface.exitance[0]};
  }
  const BuildingTree tree(panels.clusters);
  const BuildingLight light(tree, panels.scene, panels.clusters);
  EXPECT_NEAR(light.intensity(BuildingTree::root, up), 2.0 * sent_up, 1e-9);
  EXPECT_NEAR(light.emitted(BuildingTree::root, 0), 0.5 * light.emitted(BuildingTree::root, 1),
              1e-9);
}

}  // namespace
}  // namespace enfilade
