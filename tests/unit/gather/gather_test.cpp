#include "gather/gather.hpp"

#include <gtest/gtest.h>

#include <tuple>

#include "unit/gather/box_room.hpp"

namespace enfilade {
namespace {

using testing::Solved;

/// A closed furnace: exitance (1 - rho) H everywhere gives E = H everywhere, in any closed scene.
TEST(Gather, AClutteredFurnaceIsUniform) {
  Scene scene = testing::box_room({0, 0, 0}, {4, 5, 3}, {0.5, 0.8}, {0.5 * 2.0, 0.2 * 7.0});
  testing::add_block(scene, {1, 1, 0.3}, {2, 2.5, 1.2}, {0.3, 0.6}, {0.7 * 2.0, 0.4 * 7.0});
  for (const Basis basis : {Basis::constant, Basis::linear}) {
    const Solved solved(scene, basis, 1e-3);
    for (const ClusterState& state : solved.states) {
      const auto terms = static_cast<std::size_t>(state.patches().terms());
      for (std::size_t n = 0; n < state.patches().size(); ++n) {
        EXPECT_NEAR(state.patches().irradiance(n)[0], 2.0, 0.005 * 2.0);
        EXPECT_NEAR(state.patches().irradiance(n)[terms], 7.0, 0.005 * 7.0);
      }
    }
    EXPECT_NEAR(solved.absorbed_share, 1.0, 1e-3);
  }
}

/// Two parallel unit squares at distance 1, black: the exact factor is Howell's C-11, 0.199825.
TEST(Gather, ParallelSquaresMatchTheClosedForm) {
  Scene scene = testing::box_room({0, 0, 0}, {1, 1, 1}, {0.0}, {0.0});
  scene.surfaces.resize(2);
  scene.surfaces[1].exitance = {1.0};
  const Solved solved(scene, Basis::linear, 1e-4);
  EXPECT_NEAR(solved.states[0].patches().irradiance(0)[0], 0.199824895698, 1e-4);
}

/// Squares 1 mm apart: the naive centre kernel gives 318310, the truth is 0.998.
TEST(Gather, AThinGapStaysBelowOne) {
  Scene scene = testing::box_room({0, 0, 0}, {1, 1, 0.001}, {0.0}, {0.0});
  scene.surfaces.resize(2);
  scene.surfaces[1].exitance = {1.0};
  const Solved solved(scene, Basis::linear, 1e-4);
  const double e = solved.states[0].patches().irradiance(0)[0];
  EXPECT_LE(e, 1.0);
  EXPECT_NEAR(e, 0.9980056, 3e-3);
}

/// An isotropic point light in the middle of a closed cube: each face gets a sixth; then
/// interreflection E = Phi / (6 A (1 - rho)) on average.
TEST(Gather, APointLightInACubeMatchesTheIntegratingSphereFormula) {
  Scene scene = testing::box_room({0, 0, 0}, {4, 4, 4}, {0.5}, {0.0});
  scene.lights.push_back({{2, 2, 2}, {100.0}});
  const Solved solved(scene, Basis::linear, 1e-4);
  const double flux = 4.0 * 3.14159265358979 * 100.0;
  for (const ClusterState& state : solved.states) {
    EXPECT_NEAR(state.patches().irradiance(0)[0], flux / (6.0 * 16.0 * 0.5), 0.01 * flux / 48.0);
  }
}

/// A tiny lamp close to a wide floor: no sample point of the coarse floor lies below it.
TEST(Gather, DoesNotMissASmallBrightLampCloseToALargeFloor) {
  Scene scene;
  for (const auto& [half, z, up, exitance] :
       {std::tuple{50.0, 0.0, true, 0.0}, std::tuple{0.05, 0.5, false, 1.0}}) {
    Surface s;
    const double x = up ? 0.0 : 17.3, y = up ? 0.0 : -8.1;
    s.vertices = {{x - half, y - half, z},
                  {x + half, y - half, z},
                  {x + half, y + half, z},
                  {x - half, y + half, z}};
    if (!up) std::reverse(s.vertices.begin(), s.vertices.end());
    s.reflectance = {0.0};
    s.exitance = {exitance};
    scene.surfaces.push_back(s);
  }
  const Solved solved(scene, Basis::linear, 1e-3);
  // Nearly all that the lamp emits lands on the floor.
  const double received = solved.states[0].patches().irradiance(0)[0] * 100.0 * 100.0;
  EXPECT_NEAR(received, 0.1 * 0.1 * 1.0, 0.01 * 0.01);
}

/// Only the links from where the light has grown are refined; the others stay, in their order.
TEST(Gather, ReplacesTheLinksThatAreNotFineAnyMore) {
  testing::Solved solved(testing::box_room({0, 0, 0}, {3, 2, 1}, {0.5}, {1.0}), Basis::linear,
                         1e-3);
  ClusterState& receiver = solved.states[0];
  std::vector<ClusterId> all;
  for (const Cluster& c : solved.clusters) all.push_back(c.id);
  GatherConfig config;
  config.iteration = solved.iterations + 1;
  config.refinement.link_tolerance = 1e-3 * emitted_power(solved.scene, solved.clusters)[0];
  config.refinement.min_area_m2 = 1e-8;
  const auto again = [&] {
    gather(
        receiver, {all},
        [&](ClusterId id) -> const ClusterState& { return solved.states[id.index()]; }, {},
        solved.occluders, config);
  };
  const LinkSet before = receiver.links();
  const auto bytes = receiver.bytes_of(Section::links);
  again();
  EXPECT_EQ(receiver.bytes_of(Section::links), bytes);
  PatchForest& bright = solved.states[2].patches();
  for (std::size_t n = 0; n < bright.size(); ++n) bright.radiosity(n)[0] *= 100.0;
  again();
  const LinkSet& after = receiver.links();
  EXPECT_GT(after.size(), before.size());
  const auto others = [](const LinkSet& links) {
    std::vector<std::tuple<std::uint32_t, PatchId, PatchId, float>> kept;
    for (std::size_t i = 0; i < links.size(); ++i) {
      if (links[i].shooter_cluster == ClusterId(2u)) continue;
      kept.emplace_back(links[i].shooter_cluster.value, links[i].shooter, links[i].receiver,
                        links.transport(i)[0]);
    }
    return kept;
  };
  EXPECT_EQ(others(after), others(before));
  for (std::size_t i = 1; i < after.size(); ++i)
    EXPECT_LE(after[i - 1].shooter_cluster, after[i].shooter_cluster);
}

TEST(Gather, NoLightGivesNoWorkAndZero) {
  const Solved solved(testing::box_room({0, 0, 0}, {4, 4, 4}, {0.5}, {0.0}), Basis::linear, 1e-3,
                      true, 6);
  EXPECT_EQ(solved.work.form_factors, 0u);
  EXPECT_EQ(solved.states[0].patches().irradiance(0)[0], 0.0);
}

TEST(Gather, TellsWhetherTheLinksChanged) {
  Scene scene = testing::box_room({0, 0, 0}, {3, 4, 2}, {0.5}, {1.0});
  scene.lights.push_back({{1.5, 2, 1}, {0.0}});  // links to it are refined each time, to no effect
  const std::vector<Cluster> clusters = testing::clusters_of(scene);
  const Occluders occluders(clusters);
  std::vector<ClusterState> states;
  std::vector<ClusterId> all;
  for (const Cluster& c : clusters) {
    states.emplace_back(c, scene, Basis::linear);
    all.push_back(c.id);
  }
  GatherConfig config;
  config.refinement.link_tolerance = 0.01;
  std::vector<int> changed(6, 0);
  for (config.iteration = 1; config.iteration < 6; ++config.iteration) {
    for (ClusterState& receiver : states) {
      const LinkSet before = receiver.links();
      const GatherResult result = gather(
          receiver, {all},
          [&states](ClusterId id) -> const ClusterState& { return states[id.index()]; },
          scene.lights, occluders, config);
      EXPECT_EQ(result.links_changed, !(receiver.links() == before)) << config.iteration;
      changed[static_cast<std::size_t>(config.iteration)] += result.links_changed ? 1 : 0;
    }
  }
  EXPECT_GT(changed[1], 0);
  EXPECT_EQ(changed[5], 0);
}

TEST(Gather, BandsShareTheirLinks) {
  const Spectrum rho(8, 0.5), exitance(8, 1.0);
  const Solved eight(testing::box_room({0, 0, 0}, {3, 4, 2}, rho, exitance), Basis::linear, 1e-3);
  const Solved one(testing::box_room({0, 0, 0}, {3, 4, 2}, {0.5}, {1.0}), Basis::linear, 1e-3);
  EXPECT_EQ(eight.links, one.links);
  EXPECT_EQ(eight.work.rays, one.work.rays);
}

TEST(EmittedPower, CountsSurfacesAndLights) {
  Scene scene = testing::box_room({0, 0, 0}, {1, 2, 3}, {0.5}, {2.0});
  scene.lights.push_back({{0.5, 1, 1}, {1.0}});
  const double expected = 2.0 * (2 * (1 * 2 + 2 * 3 + 1 * 3)) + 4.0 * 3.14159265358979;
  EXPECT_NEAR(emitted_power(scene, testing::clusters_of(scene))[0], expected, 1e-9);
}

}  // namespace
}  // namespace enfilade
