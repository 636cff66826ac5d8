#include "gather/gathered_light.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "links/link_side.hpp"
#include "unit/gather/box_room.hpp"

namespace enfilade {
namespace {

Surface quad(Vec3 a, Vec3 u, Vec3 v, double exitance, std::string object = "") {
  Surface surface;
  surface.vertices = {a, a + u, a + u + v, a + v};
  surface.reflectance = {0.5};
  surface.exitance = {exitance};
  surface.object = std::move(object);
  return surface;
}

struct TwoClusters {
  Scene scene;
  std::vector<Cluster> clusters;
  std::vector<ClusterState> states;
  explicit TwoClusters(std::vector<Surface> surfaces) {
    scene.bands = 1;
    scene.surfaces = std::move(surfaces);
    clusters = testing::clusters_of(scene);
    for (const Cluster& c : clusters) states.emplace_back(c, scene, Basis::linear);
  }
};

/// A part that its owner has not made sends its ancestor's light as it is at the part's own middle.
TEST(GatheredLight, OfAPartThatIsNotMadeIsItsAncestorsThere) {
  TwoClusters two(
      {quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0.0), quad({0, 0, 1}, {0, 3, 0}, {2, 0, 0}, 1.0)});
  PatchForest& shooter = two.states[1].patches();
  const std::span<double> light = shooter.radiosity(0);
  light[0] = 5.0;
  light[1] = 0.7;
  light[2] = -0.4;
  GatheredLight gathered(two.states[0].patches(), {}, nullptr);
  for (const std::uint32_t path : {1u, 2u, 3u, 5u, 6u, 12u, 31u}) {
    Link link;
    link.shooter_cluster = ClusterId(1u);
    link.shooter = {0, path};
    const LinkSide side = LinkSide::of(shooter, ClusterId(1u), link.shooter);
    link.shooter_x = static_cast<float>(side.shape.centroid.x);
    link.shooter_y = static_cast<float>(side.shape.centroid.y);
    gathered.read(link, {}, &shooter);
    const Vec2 d = side.shape.centroid - shooter.node(0).shape.centroid;
    EXPECT_NEAR(gathered.means()[0], 5.0 + 0.7 * d.x - 0.4 * d.y, 1e-5) << path;
    // And what arrives: the slopes are those of the ancestor.
    std::array<float, 9> transport{0.25f, 0.5f, -0.125f, 0, 0, 0, 0, 0, 0};
    GatheredLight one(two.states[0].patches(), {}, nullptr);
    link.receiver = {0, 1};
    one.read(link, {}, &shooter);
    one.receive(link, transport);
    EXPECT_NEAR(one.irradiance()[0], 0.25 * gathered.means()[0] + 0.5 * 0.7 - 0.125 * -0.4, 1e-5);
  }
}

/// A group's polygons receive by their cosine to the light; those that face away, nothing.
TEST(GatheredLight, OfAGroupGoesByTheCosine) {
  TwoClusters two({quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0.0, "group"),      // up
                   quad({2, 0, 0}, {0.6, 0, 0.8}, {0, 1, 0}, 0.0, "group"),  // leans
                   quad({4, 0, 0}, {0, 1, 0}, {1, 0, 0}, 0.0, "group"),      // down
                   quad({0, 0, 9}, {0, 1, 0}, {1, 0, 0}, 2.0)});
  const PatchForest& receiver = two.states[0].patches();
  ASSERT_EQ(receiver.polygons(), 3u);
  Link link;
  link.receiver = receiver.root();
  ASSERT_TRUE(link.receiver.is_group());
  link.shooter_cluster = ClusterId(1u);
  GatheredLight gathered(receiver, {}, nullptr);
  gathered.read(link, {}, &two.states[1].patches());
  const std::array<float, 9> transport{0.3f, 0.0f, 0.0f, 1.0f, 0, 0, 0, 0, 0};
  gathered.receive(link, transport);
  const std::vector<double>& irradiance = gathered.irradiance();
  EXPECT_NEAR(irradiance[0 * 3], 0.3 * 2.0, 1e-6);
  EXPECT_NEAR(irradiance[1 * 3], 0.3 * 2.0 * 0.6, 1e-6);
  EXPECT_EQ(irradiance[2 * 3], 0.0);
  EXPECT_NEAR(gathered.power()[0], 0.3 * 2.0 * (1.0 + 0.6), 1e-6);
}

}  // namespace
}  // namespace enfilade
