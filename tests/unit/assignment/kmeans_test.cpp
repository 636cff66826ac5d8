#include "assignment/kmeans.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "unit/assignment/warshall.hpp"

namespace enfilade {
namespace {

using test::building;
using test::random_graph;
using test::warshall;

AssignmentConfig kmeans(int parts, std::uint64_t seed = 1) {
  AssignmentConfig config;
  config.parts = parts;
  config.seed = seed;
  return config;
}

TEST(Kmeans, CentreOfGravityIsTheMostCentralElement) {
  const ClusterGraph graph = random_graph(90, 0.05, 11);
  const auto hops = warshall(graph);
  std::vector<Rank> owner(graph.size());
  for (std::size_t v = 0; v < owner.size(); ++v) owner[v] = Rank{static_cast<int>(v * 7 % 4)};
  const auto centres = centres_of_gravity(graph, owner, 4, graph.size());
  for (int g = 0; g < 4; ++g) {
    std::tuple<std::uint64_t, std::uint32_t, std::uint32_t> best{~0ull, 0, 0};
    for (std::uint32_t v = 0; v < graph.size(); ++v) {
      if (owner[v].value != g) continue;
      std::uint64_t sum = 0;
      std::uint32_t max = 0;
      for (std::uint32_t w = 0; w < graph.size(); ++w) {
        if (owner[w].value == g) sum += hops[v][w], max = std::max(max, hops[v][w]);
      }
      best = std::min(best, std::tuple(sum, max, v));
    }
    EXPECT_EQ(centres[static_cast<std::size_t>(g)], std::get<2>(best));
  }
}

TEST(Kmeans, SampledCentreIsNearlyAsCentral) {
  const ClusterGraph graph = building(2, 20, 25, 0.05, 5);
  const std::vector<Rank> owner(graph.size(), Rank{0});
  const auto sum_of = [&](std::uint32_t v) {
    double sum = 0;
    for (std::uint32_t h : hop_distances(graph, v)) sum += h;
    return sum;
  };
  const double exact = sum_of(centres_of_gravity(graph, owner, 1, graph.size())[0]);
  EXPECT_LE(sum_of(centres_of_gravity(graph, owner, 1, 64)[0]), 1.1 * exact);
}

TEST(Kmeans, EveryNodeIsWithANearestCentre) {
  const ClusterGraph graph = building(1, 30, 10, 0.1, 2);
  const auto owner = kmeans_groups(graph, kmeans(5));
  // The loop ends where the groups' own centres of gravity give the same groups again.
  const auto centres = centres_of_gravity(graph, owner, 5, graph.size());
  const auto hops = warshall(graph);
  std::size_t nearest = 0;
  for (std::size_t v = 0; v < graph.size(); ++v) {
    std::uint32_t least = 1000;
    for (std::uint32_t c : centres) least = std::min(least, hops[v][c]);
    nearest += hops[v][centres[static_cast<std::size_t>(owner[v].value)]] == least;
  }
  // It may also end in a cycle of groupings, so that a few border nodes are one hop off.
  EXPECT_GE(nearest, graph.size() * 95 / 100);
}

TEST(Kmeans, DisconnectedPartsAreGroupedToo) {
  // Eight islands and four groups: some islands hold no centre.
  test::Pairs pairs;
  for (std::uint32_t island = 0; island < 8; ++island) {
    for (std::uint32_t a = 0; a < 10; ++a) {
      for (std::uint32_t b = a + 1; b < 10; ++b)
        pairs.emplace_back(island * 10 + a, island * 10 + b);
    }
  }
  const ClusterGraph graph(80, pairs);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto owner = kmeans_groups(graph, kmeans(4, seed));
    const PartitionQuality q = quality(graph, owner, 4);
    EXPECT_LE(q.imbalance, 1.5) << "seed " << seed;
    EXPECT_LE(q.edge_cut, graph.edges() / 4) << "seed " << seed;
  }
}

TEST(Kmeans, SameSeedSameGroups) {
  const ClusterGraph graph = building(2, 15, 12, 0.08, 4);
  EXPECT_EQ(kmeans_groups(graph, kmeans(6, 9)), kmeans_groups(graph, kmeans(6, 9)));
}

TEST(Kmeans, TakesTheBestOfItsStarts) {
  const ClusterGraph graph = building(2, 15, 12, 0.08, 4);
  AssignmentConfig config = kmeans(6);
  std::vector<std::size_t> cuts;
  for (config.starts = 1; config.starts <= 8; ++config.starts) {
    const PartitionQuality q = quality(graph, kmeans_groups(graph, config), 6);
    if (q.imbalance <= 1.25) cuts.push_back(q.edge_cut);
  }
  ASSERT_FALSE(cuts.empty());
  EXPECT_TRUE(std::is_sorted(cuts.rbegin(), cuts.rend()));
  EXPECT_LT(cuts.back(), cuts.front());
}

TEST(Kmeans, EndsWithinTheGivenRounds) {
  const ClusterGraph graph = building(1, 40, 5, 0.2, 8);
  AssignmentConfig config = kmeans(7);
  config.max_iterations = 0;  // the first random centres only
  const auto first = kmeans_groups(graph, config);
  config.max_iterations = 30;
  const auto last = kmeans_groups(graph, config);
  EXPECT_LT(quality(graph, last, 7).edge_cut, quality(graph, first, 7).edge_cut);
}

}  // namespace
}  // namespace enfilade
