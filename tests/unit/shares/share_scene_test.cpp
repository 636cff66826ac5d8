#include "shares/share_scene.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/gather/box_room.hpp"

namespace enfilade {
namespace {

using ::testing::ElementsAre;

/// A box of two bands, its ceiling and floor shining, and a point light.
Scene two_bands() {
  Scene scene = testing::box_room({0, 0, 0}, {4, 3, 2}, {0.5, 0.2}, {0.0, 0.0});
  scene.surfaces[0].exitance = {1.0, 2.0};
  scene.surfaces[0].name = "floor";
  scene.surfaces[1].exitance = {5.0, 0.0};
  scene.surfaces[1].name = "ceiling";
  scene.lights.push_back({Vec3(2, 1, 1), {7.0, 8.0}});
  scene.lights[0].name = "bulb";
  return scene;
}

TEST(ShareScene, HasTheWholeLightAndThenEachGroupsOwn) {
  Scene scene = two_bands();
  scene.surfaces[3].transmittance = {.4, .1};
  const Scene wide = share_scene(scene, share_groups(scene));  // bulb, floor, ceiling
  EXPECT_EQ(wide.bands, 8);
  EXPECT_EQ(wide.lead_bands, 2);
  EXPECT_THAT(wide.surfaces[0].exitance, ElementsAre(1, 2, 0, 0, 1, 2, 0, 0));
  EXPECT_THAT(wide.surfaces[1].exitance, ElementsAre(5, 0, 0, 0, 0, 0, 5, 0));
  EXPECT_THAT(wide.surfaces[2].exitance, ElementsAre(0, 0, 0, 0, 0, 0, 0, 0));
  EXPECT_THAT(wide.surfaces[2].reflectance, ElementsAre(.5, .2, .5, .2, .5, .2, .5, .2));
  EXPECT_THAT(wide.surfaces[3].transmittance, ElementsAre(.4, .1, .4, .1, .4, .1, .4, .1));
  EXPECT_TRUE(wide.surfaces[2].transmittance.empty());
  EXPECT_THAT(wide.lights[0].intensity, ElementsAre(7, 8, 7, 8, 0, 0, 0, 0));
  EXPECT_EQ(share_band(2, 1, 0), 4u);
}

TEST(ShareScene, OfSomeGroupsLeavesTheOthersOutOfAllShares) {
  const Scene scene = two_bands();
  const std::vector<ShareGroup> groups = share_groups(scene);
  const Scene wide = share_scene(scene, std::span(groups).subspan(1, 1));
  EXPECT_THAT(wide.surfaces[0].exitance, ElementsAre(1, 2, 1, 2));
  EXPECT_THAT(wide.surfaces[1].exitance, ElementsAre(5, 0, 0, 0));
  EXPECT_THAT(wide.lights[0].intensity, ElementsAre(7, 8, 0, 0));
}

TEST(ShareScene, DimmedHasTheFactorsOfItsGroups) {
  const Scene scene = two_bands();
  const Scene dimmed = dimmed_scene(scene, share_groups(scene), std::vector{0.5, 0.0, 2.0});
  EXPECT_THAT(dimmed.lights[0].intensity, ElementsAre(3.5, 4.0));
  EXPECT_THAT(dimmed.surfaces[0].exitance, ElementsAre(0, 0));
  EXPECT_THAT(dimmed.surfaces[1].exitance, ElementsAre(10, 0));
}

TEST(SamePatches, HaveTheOldOnesCutsAndLinksAndTheNewSceneLight) {
  const Scene scene = two_bands();
  const std::vector<Cluster> clusters = testing::clusters_of(scene);
  ClusterState state(clusters[0], scene, Basis::linear);
  PatchForest& patches = state.patches();
  patches.subdivide(patches.subdivide(0) + 1);
  for (std::size_t n = 0; n < patches.size(); ++n) {
    patches.set_enclosed_share(n, 0.1f * static_cast<float>(n), n % 2 == 0);
    patches.set_link_error(n, 0.2f * static_cast<float>(n));
  }
  patches.mark_unreachable(0);
  Link link;
  link.shooter_cluster = ClusterId(1u);
  link.error = 3.0f;
  state.links().add(link, std::vector<float>(state.links().stride(), 0.25f));

  const Scene wide = share_scene(scene, share_groups(scene));
  const ClusterState same = same_patches(state, clusters[0], wide);
  EXPECT_EQ(same.bands(), 8);
  EXPECT_EQ(same.patches().lead_bands(), 2);
  EXPECT_TRUE(same.links() == state.links());
  EXPECT_TRUE(same.patches().unreachable(0));
  ASSERT_EQ(same.patches().size(), patches.size());
  for (std::size_t n = 0; n < patches.size(); ++n) {
    EXPECT_EQ(same.patches().node(n).id, patches.node(n).id);
    EXPECT_EQ(same.patches().node(n).shape.area_m2, patches.node(n).shape.area_m2);
    EXPECT_EQ(same.patches().enclosed_share(n), patches.enclosed_share(n));
    EXPECT_EQ(same.patches().enclosed_share_settled(n), n % 2 == 0);
    EXPECT_EQ(same.patches().link_error(n), patches.link_error(n));
    EXPECT_EQ(same.patches().irradiance(n)[0], 0.0);
    EXPECT_EQ(same.patches().radiosity(n)[3 * share_band(2, 1, 1)], 2.0);
    EXPECT_EQ(same.patches().radiosity(n)[3 * share_band(2, 2, 1)], 0.0);
  }
}

TEST(LeadBands, AloneDecideWhatIsLitAndHowMuchLightVaries) {
  Scene scene = testing::box_room({0, 0, 0}, {4, 3, 2}, {1.0, 1.0}, {0.0, 0.0});
  const std::vector<Cluster> clusters = testing::clusters_of(scene);
  for (const int lead : {1, 2}) {
    scene.lead_bands = lead;
    ClusterState state(clusters[0], scene, Basis::constant);
    PatchForest& patches = state.patches();
    const std::size_t first = patches.subdivide(0);
    patches.irradiance(first)[1] = 4.0;  // the second band of one half
    patches.pull();
    EXPECT_EQ(patches.lit_polygons(), lead == 1 ? 0u : 1u);
    EXPECT_NEAR(patches.deviation(0), lead == 1 ? 0.0 : 2.0, 1e-12);
  }
}

}  // namespace
}  // namespace enfilade
