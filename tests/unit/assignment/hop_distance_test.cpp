#include "assignment/hop_distance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "assignment/assignment.hpp"
#include "unit/assignment/warshall.hpp"

namespace enfilade {
namespace {

using test::random_graph;
using test::warshall;

TEST(HopDistance, EqualsWarshallOnRandomGraphs) {
  // From far below to above the density at which such graphs become connected.
  for (double density : {0.01, 0.03, 0.06, 0.2}) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const ClusterGraph graph = random_graph(60, density, seed);
      const auto expected = warshall(graph);
      for (std::size_t v = 0; v < graph.size(); ++v) {
        const auto hops = hop_distances(graph, v);
        for (std::size_t to = 0; to < graph.size(); ++to) {
          const bool unreachable = expected[v][to] == graph.size();
          ASSERT_EQ(hops[to], unreachable ? 0xFFFFFFFFu : expected[v][to]) << v << " to " << to;
        }
      }
    }
  }
}

TEST(HopDistance, NearestSourcesEqualWarshall) {
  const ClusterGraph graph = random_graph(150, 0.015, 7);
  const auto hops = warshall(graph);
  std::vector<std::uint32_t> sources(70);
  for (std::size_t s = 0; s < sources.size(); ++s)
    sources[s] = static_cast<std::uint32_t>(2 * s + 1);
  const NearestSources nearest = nearest_sources(graph, sources);
  bool some_unreached = false;
  for (std::size_t v = 0; v < graph.size(); ++v) {
    std::uint32_t least = static_cast<std::uint32_t>(graph.size());
    for (std::uint32_t s : sources) least = std::min(least, hops[v][s]);
    some_unreached |= least == graph.size();
    for (std::size_t s = 0; s < sources.size(); ++s) {
      const bool in_set = (nearest.of(v)[s / 64] >> (s % 64)) & 1u;
      EXPECT_EQ(in_set, least < graph.size() && hops[v][sources[s]] == least) << v << " " << s;
    }
  }
  EXPECT_TRUE(some_unreached) << "the graph shall have nodes that no source reaches";
}

TEST(HopDistance, CentralityEqualsWarshallBeyondOneBatch) {
  const ClusterGraph graph = random_graph(400, 0.006, 3);
  const auto hops = warshall(graph);
  std::vector<std::uint32_t> group(graph.size()), pivots;
  for (std::uint32_t v = 0; v < graph.size(); ++v) {
    group[v] = v % 3;
    if (v % 5 != 0) pivots.push_back(v);
  }
  ASSERT_GT(pivots.size(), 256u);
  const Centrality central = centrality(graph, group, pivots);
  for (std::uint32_t v = 0; v < graph.size(); ++v) {
    std::uint64_t sum = 0;
    std::uint32_t max = 0;
    for (std::uint32_t p : pivots) {
      if (group[p] != group[v]) continue;
      sum += hops[v][p];
      max = std::max(max, hops[v][p]);
    }
    EXPECT_EQ(central.sum[v], sum) << v;
    EXPECT_EQ(central.max[v], max) << v;
  }
}

}  // namespace
}  // namespace enfilade
