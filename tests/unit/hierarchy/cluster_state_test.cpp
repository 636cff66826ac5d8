#include "hierarchy/cluster_state.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "unit/gather/box_room.hpp"

namespace enfilade {
namespace {

TEST(ClusterState, SurvivesItsFile) {
  Scene scene = testing::box_room({0, 0, 0}, {3, 2, 1}, {0.5, 0.2}, {1.0, 0.3});
  testing::add_block(scene, {1, 0.5, 0}, {1.5, 1, 0.6}, {0.4, 0.4}, {0.0, 0.0});
  const testing::Solved solved(scene, Basis::linear, 1e-3);
  const ClusterState& state = solved.states.back();
  ASSERT_GT(state.links().size(), 0u);
  const ClusterState copy(state.bytes_of(Section::geometry), state.bytes_of(Section::patches),
                          state.bytes_of(Section::links));
  EXPECT_EQ(copy.id(), state.id());
  EXPECT_EQ(copy.iteration(), state.iteration());
  EXPECT_EQ(copy.patches().size(), state.patches().size());
  for (const Section s : {Section::geometry, Section::patches, Section::links}) {
    EXPECT_EQ(copy.bytes_of(s).size(), state.bytes_of(s).size());
  }
  for (std::size_t n = 0; n < state.patches().size(); ++n) {
    EXPECT_EQ(copy.patches().node(n).id, state.patches().node(n).id);
    EXPECT_NEAR(copy.patches().node(n).shape.area_m2, state.patches().node(n).shape.area_m2, 1e-15);
    EXPECT_EQ(copy.patches().radiosity(n)[0], state.patches().radiosity(n)[0]);
  }
}

TEST(ClusterState, KeepsTheLightOfAnEarlierIterationUntilAPatchIsMade) {
  const Scene scene = testing::box_room({0, 0, 0}, {3, 2, 1}, {0.5}, {1.0});
  ClusterState state(testing::clusters_of(scene)[0], scene, Basis::linear);
  state.patches().irradiance(0)[0] = 0.75;
  state.patches().keep_light();
  ClusterState copy(state.bytes_of(Section::geometry), state.bytes_of(Section::patches), {});
  const std::vector<double> kept = copy.patches().take_kept_light();
  ASSERT_EQ(kept.size(), 3u);
  EXPECT_EQ(kept[0], 0.75f);
  EXPECT_TRUE(copy.patches().take_kept_light().empty());
  state.patches().subdivide(0);
  EXPECT_TRUE(state.patches().take_kept_light().empty());
}

/// A replay counts the memory that was recorded for a cluster that had been read.
TEST(ClusterState, TakesAsMuchMemoryWhenItIsRead) {
  const Scene scene = testing::box_room({0, 0, 0}, {3, 2, 1}, {0.5}, {1.0});
  for (const std::size_t aggregates : {1u, 11u}) {
    ClusterState state(testing::clusters_of(scene)[0], scene, Basis::linear, aggregates);
    state.patches().subdivide(state.patches().subdivide(0));
    state.shrink();
    const ClusterState copy(state.bytes_of(Section::geometry), state.bytes_of(Section::patches),
                            {});
    EXPECT_EQ(copy.memory_bytes(), state.memory_bytes()) << aggregates;
  }
}

TEST(ClusterState, RefusesATornRecord) {
  const Scene scene = testing::box_room({0, 0, 0}, {3, 2, 1}, {0.5}, {1.0});
  const ClusterState state(testing::clusters_of(scene)[0], scene, Basis::linear);
  const auto geometry = state.bytes_of(Section::geometry);
  auto patches = state.bytes_of(Section::patches);
  patches.resize(patches.size() / 2);
  EXPECT_THROW(ClusterState(geometry, patches, {}), RunError);
}

TEST(ClusterState, RefusesARecordThatGoesOnOrIsOfAnotherBasis) {
  const Scene scene = testing::box_room({0, 0, 0}, {3, 2, 1}, {0.5}, {1.0});
  const Cluster cluster = testing::clusters_of(scene)[0];
  const ClusterState linear(cluster, scene, Basis::linear), flat(cluster, scene, Basis::constant);
  const auto links = linear.bytes_of(Section::links);
  std::vector<std::byte> sections[] = {linear.bytes_of(Section::geometry),
                                       linear.bytes_of(Section::patches), links};
  EXPECT_NO_THROW(ClusterState(sections[0], sections[1], sections[2]));
  for (std::vector<std::byte>& section : sections) {
    section.push_back(std::byte{0});
    EXPECT_THROW(ClusterState(sections[0], sections[1], sections[2]), RunError);
    section.pop_back();
  }
  EXPECT_THROW(
      ClusterState(flat.bytes_of(Section::geometry), flat.bytes_of(Section::patches), links),
      RunError);
}

}  // namespace
}  // namespace enfilade
