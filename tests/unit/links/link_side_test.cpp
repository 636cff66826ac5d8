#include "links/link_side.hpp"

#include <gtest/gtest.h>

#include "unit/gather/box_room.hpp"

namespace enfilade {
namespace {

TEST(NodeLight, EqualsTheLightOfALinksSide) {
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

}  // namespace
}  // namespace enfilade
