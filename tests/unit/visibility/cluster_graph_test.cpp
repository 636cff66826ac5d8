// No visible pair may be missing: random segments between front sides, tested against every polygon
// in double precision, must all join clusters that G_cluster joins.
#include "visibility/cluster_graph.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "unit/visibility/random_segments.hpp"

namespace enfilade {
namespace {

using testing::enfilade_of_rooms;
using testing::expect_no_pair_missed;
using testing::prepare;
using testing::Prepared;

TEST(ClusterGraph, RowsAreSortedAndSymmetric) {
  const ClusterGraph graph(4, {{2, 1}, {1, 2}, {0, 3}, {3, 1}, {2, 2}});
  EXPECT_EQ(graph.edges(), 3u);
  EXPECT_TRUE(graph.has_edge(1, 3) && graph.has_edge(3, 1) && !graph.has_edge(0, 1));
  const auto row = graph.neighbours(1);
  EXPECT_EQ(std::vector<std::uint32_t>(row.begin(), row.end()), (std::vector<std::uint32_t>{2, 3}));
}

TEST(ClusterGraph, ComesBackFromBytes) {
  const ClusterGraph graph(5, {{0, 3}, {3, 1}, {4, 3}, {0, 1}});
  const ClusterGraph back = graph_from_bytes(to_bytes(graph));
  ASSERT_EQ(back.size(), 5u);
  EXPECT_EQ(back.edges(), 4u);
  for (std::size_t i = 0; i < 5; ++i) {
    for (std::size_t j = 0; j < 5; ++j)
      EXPECT_EQ(back.has_edge(i, j), graph.has_edge(i, j)) << i << " " << j;
  }
  EXPECT_EQ(graph_from_bytes(to_bytes(ClusterGraph(3, {}))).size(), 3u);
}

TEST(ClusterGraph, CutOrAlteredBytesAreRefused) {
  const std::string bytes = to_bytes(ClusterGraph(2, {{0, 1}}));
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_THROW(graph_from_bytes(bytes.substr(0, size)), RunError) << size;
  EXPECT_THROW(graph_from_bytes(bytes + '\0'), RunError);
  EXPECT_THROW(graph_from_bytes("enfilade-graph 1 2 1\ncluster-0 0 1\ncluster-1 1 0\n"), RunError);
  std::string other = bytes;
  other[0] = 'E';
  EXPECT_THROW(graph_from_bytes(other), RunError);
  // The edge's end, a number of four bytes, comes before the empty row of the last cluster.
  const std::size_t end = bytes.size() - sizeof(std::uint64_t) - sizeof(std::uint32_t);
  std::string beyond = bytes;
  ASSERT_EQ(beyond[end], 1);
  beyond[end] = 7;  // there is no such cluster
  EXPECT_THROW(graph_from_bytes(beyond), RunError);
}

TEST(NeighbourGraph, JoinsWhatComesNextInTheTree) {
  const Prepared p = prepare(enfilade_of_rooms());
  const BuildingTree tree(p.clusters);
  const std::size_t n = p.clusters.size();
  ASSERT_GT(n, 20u);
  for (const std::size_t reach : {std::size_t{1}, std::size_t{3}, 2 * n}) {
    const ClusterGraph graph = neighbour_graph(tree, reach);
    ASSERT_EQ(graph.size(), n);
    std::size_t edges = 0;
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = i + 1; j < n; ++j) {
        const bool near = j - i <= reach;
        edges += near ? 1 : 0;
        EXPECT_EQ(graph.has_edge(tree.clusters()[i].index(), tree.clusters()[j].index()), near);
      }
    }
    EXPECT_EQ(graph.edges(), edges);
  }
}

TEST(VisibleClusters, WallsOfARoomSeeEachOther) {
  const Prepared p = prepare(plan::one_room());
  EXPECT_EQ(p.graph.edges(), 15u);
}

TEST(VisibleClusters, NoPairMissedThroughADoor) {
  const Prepared p = prepare(plan::two_rooms());
  EXPECT_GT(expect_no_pair_missed(p, 200000), 30u);
}

TEST(VisibleClusters, NoPairMissedThroughAStairHole) {
  EXPECT_GT(expect_no_pair_missed(prepare(plan::two_storeys()), 200000), 20u);
}

TEST(VisibleClusters, NoPairMissedInATurnedBuildingFarAway) {
  plan::Plan plan = enfilade_of_rooms();
  plan.transform(plan::turn_and_move(1e5));
  EXPECT_GT(expect_no_pair_missed(prepare(plan), 200000), 100u);
}

TEST(VisibleClusters, NoPairMissedWhenSequencesAreCutShort) {
  VisibilityConfig config;
  config.max_passes = 0;
  EXPECT_GT(expect_no_pair_missed(prepare(enfilade_of_rooms(), config), 200000), 100u);
}

TEST(VisibleClusters, NoPairMissedWherePairsAreProvedHidden) {
  plan::Plan plan = enfilade_of_rooms();
  plan.transform(plan::turn_and_move(1e3));
  VisibilityConfig config;
  config.prove_hidden = false;
  const Prepared loose = prepare(plan, config), tight = prepare(plan);
  const std::size_t found = expect_no_pair_missed(tight, 200000);
  EXPECT_LT(tight.graph.edges(), loose.graph.edges());
  EXPECT_LT(static_cast<double>(tight.graph.edges()), 1.5 * static_cast<double>(found));
}

TEST(VisibleClusters, RoomsThatNoLineJoinsDoNotSeeEachOther) {
  const Prepared p = prepare(enfilade_of_rooms());
  const CellId first = p.complex.locate({0.5, 0.5, 2}), last = p.complex.locate({19.5, 0.5, 2});
  ASSERT_NE(first, last);
  ASSERT_EQ(p.complex.portals().size(), 4u);
  for (const Cluster& a : p.clusters) {
    for (const Cluster& b : p.clusters) {
      if (a.cell == first && b.cell == last) {
        EXPECT_FALSE(p.graph.has_edge(a.id.index(), b.id.index()));
      }
    }
  }
  const std::size_t found = expect_no_pair_missed(p, 200000);
  EXPECT_LT(static_cast<double>(p.graph.edges()), 2.0 * static_cast<double>(found));
}

TEST(VisibleCells, FollowTheDoorsThatStandInLine) {
  plan::Plan plan;
  plan.box({0, 0, 0}, {12, 4, 2.5}, true);
  plan.wall_with_door(4, 0, 4, 2.5, 1, 1.9, 2);
  plan.wall_with_door(8, 0, 4, 2.5, 1, 1.9, 2);
  const CellComplex complex = build_cells(plan.pieces(), {});
  EXPECT_EQ(visible_cells(complex).size(), 6u);  // three cells with themselves, and all three pairs
}

}  // namespace
}  // namespace enfilade
