#include "assignment/greedy_groups.hpp"

#include <gtest/gtest.h>

#include "unit/visibility/test_graphs.hpp"

namespace enfilade {
namespace {

/// Clusters of one square metre along a line; only where they stand matters.
std::vector<Cluster> on_a_line(const std::vector<double>& x_m) {
  std::vector<Cluster> clusters;
  for (double x : x_m) {
    Cluster cluster;
    cluster.bounds.add(Vec3(x, 0, 0));
    cluster.area_m2 = 1.0;
    clusters.push_back(cluster);
  }
  return clusters;
}

ClusterGraph complete(std::uint32_t nodes) { return test::random_graph(nodes, 1.1, 1); }

TEST(GreedyGroups, CutsTwoBlobsAtTheirBridge) {
  test::Pairs pairs{{9, 10}};
  for (std::uint32_t blob : {0u, 10u}) {
    for (std::uint32_t a = blob; a < blob + 10; ++a) {
      for (std::uint32_t b = a + 1; b < blob + 10; ++b) pairs.emplace_back(a, b);
    }
  }
  const ClusterGraph graph(20, pairs);
  const auto owner = greedy_groups(graph, {}, 2);
  EXPECT_EQ(quality(graph, owner, 2).edge_cut, 1u);
  EXPECT_DOUBLE_EQ(quality(graph, owner, 2).imbalance, 1.0);
}

TEST(GreedyGroups, WeightsDecideWhereAllSeeAll) {
  // Hops tell nothing here; the form factors tell two crowds apart, whose ids are mixed.
  const auto clusters = on_a_line({0, 100, 1, 101, 2, 102});
  const auto owner = greedy_groups(complete(6), FormFactorEstimate(clusters), 2);
  for (std::size_t v = 0; v < 6; ++v) EXPECT_EQ(owner[v], owner[v % 2]) << v;
  EXPECT_NE(owner[0], owner[1]);
}

TEST(GreedyGroups, NextIsTheLargestSumOfWeightsNotTheLargestWeight) {
  // The group of three starts at 0 and takes 1; then 3 is as near to 0 as 2 is to 1, but 2 is
  // tied to both.
  const ClusterGraph graph(6, {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {3, 4}, {3, 5}, {4, 5}});
  const auto owner = greedy_groups(graph, FormFactorEstimate(on_a_line({0, 1, 2, -2, -3, -4})), 2);
  EXPECT_EQ(owner[0], owner[1]);
  EXPECT_EQ(owner[1], owner[2]);
  EXPECT_EQ(owner[3], owner[4]);
  EXPECT_NE(owner[2], owner[3]);
}

TEST(GreedyGroups, DifferByOneClusterAtMost) {
  const ClusterGraph graph = test::building(2, 9, 7, 0.1, 3);  // 126 clusters
  for (int parts : {1, 2, 5, 16, 64, 126}) {
    std::vector<int> size(static_cast<std::size_t>(parts), 0);
    for (Rank r : greedy_groups(graph, {}, parts)) ++size.at(static_cast<std::size_t>(r.value));
    EXPECT_LE(*std::max_element(size.begin(), size.end()),
              *std::min_element(size.begin(), size.end()) + 1)
        << parts;
  }
}

TEST(GreedyGroups, FillsAGroupFromSeveralIslands) {
  // Four islands of five: two groups of two islands each, no island cut.
  test::Pairs pairs;
  for (std::uint32_t island = 0; island < 20; island += 5) {
    for (std::uint32_t a = island; a < island + 5; ++a) {
      for (std::uint32_t b = a + 1; b < island + 5; ++b) pairs.emplace_back(a, b);
    }
  }
  const ClusterGraph graph(20, pairs);
  EXPECT_EQ(quality(graph, greedy_groups(graph, {}, 2), 2).edge_cut, 0u);
}

}  // namespace
}  // namespace enfilade
