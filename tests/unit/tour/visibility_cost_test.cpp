#include <gtest/gtest.h>

#include <set>

#include "unit/tour/tour_costs.hpp"

namespace enfilade {
namespace {

constexpr std::uint64_t much_memory = 1ull << 40;

/// The clusters that `cluster` needs, as a set read from the graph.
std::set<std::uint32_t> needs(const ClusterGraph& graph, std::uint32_t cluster) {
  const auto row = graph.neighbours(cluster);
  std::set<std::uint32_t> set(row.begin(), row.end());
  set.insert(cluster);
  return set;
}

TEST(VisibilityCost, EqualsSetDifference) {
  const ClusterGraph graph = test::random_graph(200, 0.1, 3);
  const auto bytes = test::random_bytes(200, 4), links = test::random_bytes(200, 5);
  const VisibilityCost cost(graph, bytes, much_memory, links);
  for (std::uint32_t from = 0; from < 200; from += 3) {
    for (std::uint32_t to = 0; to < 200; to += 7) {
      const auto held = needs(graph, from);
      std::uint64_t expected = links[to];
      for (std::uint32_t c : needs(graph, to)) expected += held.contains(c) ? 0 : bytes[c];
      ASSERT_EQ(cost.between(ClusterId(from), ClusterId(to)), expected) << from << " to " << to;
    }
  }
}

TEST(VisibilityCost, IsDirected) {
  // 0 sees 1; 1 sees 0 and 2, so that from 1 to 0 nothing is missing.
  const ClusterGraph graph(3, {{0, 1}, {1, 2}});
  const VisibilityCost cost(graph, {1, 10, 100}, much_memory);
  EXPECT_EQ(cost.between(ClusterId(0), ClusterId(1)), 100u);
  EXPECT_EQ(cost.between(ClusterId(1), ClusterId(0)), 0u);
}

TEST(VisibilityCost, BytesThatDoNotFitAreReadAgain) {
  const ClusterGraph graph(3, {{0, 1}, {0, 2}, {1, 2}});
  const VisibilityCost roomy(graph, {10, 10, 10}, 30), tight(graph, {10, 10, 10}, 12);
  EXPECT_EQ(roomy.between(ClusterId(0), ClusterId(1)), 0u);
  EXPECT_EQ(tight.between(ClusterId(0), ClusterId(1)), 18u);
}

TEST(VisibilityCost, GivenCountsBytesThatAreNotResident) {
  const ClusterGraph graph(4, {{0, 1}, {0, 2}});
  const VisibilityCost cost(graph, {1, 10, 100, 1000}, much_memory, {5, 5, 5, 5});
  EXPECT_EQ(cost.needed(ClusterId(0)), 116u);
  const std::vector<ClusterId> receivers{ClusterId(0), ClusterId(3)};
  EXPECT_EQ(cost.given({}, receivers), (std::vector<std::uint64_t>{116u, 1005u}));
  const std::vector<ClusterId> resident{ClusterId(2), ClusterId(3)};
  EXPECT_EQ(cost.given(resident, receivers), (std::vector<std::uint64_t>{16u, 5u}));
}

}  // namespace
}  // namespace enfilade
