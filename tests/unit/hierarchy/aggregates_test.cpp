#include "hierarchy/aggregates.hpp"

#include <gtest/gtest.h>

#include "coarse/aggregate_flow.hpp"
#include "unit/gather/box_room.hpp"

namespace enfilade {
namespace {

TEST(Aggregates, CutTheHierarchyInOrder) {
  // A cube of one cluster: the group's halves, then its polygons, then their halves.
  const Scene scene = testing::box_room({0, 0, 0}, {2, 2, 2}, {0.5}, {1.0});
  Cluster all;
  for (const Cluster& c : testing::clusters_of(scene)) {
    all.polygons.insert(all.polygons.end(), c.polygons.begin(), c.polygons.end());
    all.area_m2 += c.area_m2;
  }
  for (const std::size_t most : {1u, 2u, 6u, 12u}) {
    ClusterState state(all, scene, Basis::constant, most);
    const Aggregates& aggregates = state.aggregates();
    PatchForest& f = state.patches();
    EXPECT_EQ(aggregates.size(), most);
    EXPECT_EQ(aggregates.of(f, f.root()).size(), most);
    std::uint32_t next = 0;
    for (std::uint32_t i = 0; i < f.polygons(); ++i) {  // neighbours in the order share or follow
      const Aggregates::Range range = aggregates.of(f, {f.order()[i], 1});
      EXPECT_TRUE(range.begin == next || range.begin + 1 == next);
      next = range.end;
    }
    EXPECT_EQ(next, most);
    // A node within one aggregate has only that one; power is divided among several by area.
    const Aggregates::Range whole = aggregates.of(f, {0, 1});
    EXPECT_EQ(whole.size(), most == 12 ? 2u : 1u);
    EXPECT_EQ(aggregates.of(f, {0, 0b1011}).size(), 1u);
    const std::vector<double> power{6.0};
    std::vector<double> sums(most, 0.0);
    aggregates.add(f, {0, 1}, power, sums);
    EXPECT_NEAR(sums[whole.begin], most == 12 ? 3.0 : 6.0, 1e-12);
    // A correction of one aggregate leaves the others unchanged.
    f.subdivide(0);
    std::vector<double> gathered(f.size(), 0.0);
    std::fill_n(gathered.begin(), f.polygons(), 1.0);
    f.push_pull(gathered);
    std::vector<double> shares(most, 0.0);
    shares[whole.begin] = 1.0;
    state.correct(shares);
    EXPECT_NEAR(f.irradiance(0)[0], most == 12 ? 1.5 : 2.0, 1e-12);
    EXPECT_NEAR(f.irradiance(f.order()[5])[0],
                most == 1           ? 2.0
                : f.order()[5] == 0 ? 1.5
                                    : 1.0,
                1e-12);
  }
}

TEST(Aggregates, AnAddedShareLeavesUnlitLeavesUnlit) {
  const Scene scene = testing::box_room({0, 0, 0}, {3, 2, 1}, {0.5, 0.5}, {0.0, 0.0});
  ClusterState state(testing::clusters_of(scene)[0], scene, Basis::constant);
  PatchForest& f = state.patches();
  const std::size_t child = f.subdivide(0);
  std::vector<double> gathered(f.size() * 2, 0.0);
  gathered[child * 2] = 6.0;  // band 0: one half lit, the other unlit
  gathered[child * 2 + 1] = 6.0;
  gathered[(child + 1) * 2 + 1] = 4.0;  // band 1: nearly even, 5 in the mean
  f.push_pull(gathered);
  state.correct(std::vector<double>{1.0, 1.0});
  EXPECT_EQ(f.irradiance(child + 1)[0], 0.0);
  EXPECT_NEAR(f.irradiance(child)[0], 12.0, 1e-12);
  EXPECT_NEAR(f.irradiance(0)[0], 6.0, 1e-12);
  // Four fifths of the mean, 5, added uniformly, and a fifth of each leaf's own irradiance.
  EXPECT_NEAR(f.irradiance(child)[1], 6.0 + 4.0 + 1.2, 1e-12);
  EXPECT_NEAR(f.irradiance(child + 1)[1], 4.0 + 4.0 + 0.8, 1e-12);
  EXPECT_NEAR(f.radiosity(0)[1], 5.0, 1e-12);
}

TEST(AggregateFlow, DividesALinkByAreaAndByReflectedPower) {
  const Scene scene = testing::box_room({0, 0, 0}, {2, 2, 2}, {0.5}, {1.0});
  const std::vector<Cluster> clusters = testing::clusters_of(scene);
  ClusterState receiver(clusters[0], scene, Basis::constant, 4);
  ClusterState shooter(clusters[1], scene, Basis::constant, 2);
  PatchForest& f = shooter.patches();
  const std::size_t child = f.subdivide(0);
  std::vector<double> gathered(f.size(), 0.0);
  gathered[child] = 3.0;  // one half gets three times as much
  gathered[child + 1] = 1.0;
  f.push_pull(gathered);
  AggregateFlow flow(receiver.patches(), receiver.aggregates(), f, shooter.aggregates());
  Link link;  // from the whole polygon to the whole polygon
  const std::vector<float> transport(4, 0.25f);
  flow.add(link, transport, std::vector<double>{8.0});
  const std::vector<double> whole = flow.take();
  ASSERT_EQ(whole.size(), 8u);
  for (std::size_t to = 0; to < 4; ++to) {
    EXPECT_NEAR(whole[2 * to], 8.0 / 4 * 0.75, 1e-12);
    EXPECT_NEAR(whole[2 * to + 1], 8.0 / 4 * 0.25, 1e-12);
  }
  AggregateFlow part(receiver.patches(), receiver.aggregates(), f, shooter.aggregates());
  link.shooter = {0, 0b11};  // from the second half alone
  part.add(link, transport, std::vector<double>{8.0});
  for (std::size_t to = 0; const double power : part.take()) {
    EXPECT_NEAR(power, to++ % 2 == 1 ? 2.0 : 0.0, 1e-12);
  }
}

}  // namespace
}  // namespace enfilade
