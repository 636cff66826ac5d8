#include <gtest/gtest.h>

#include <algorithm>

#include "tour/order.hpp"
#include "unit/tour/tour_costs.hpp"

namespace enfilade {
namespace {

constexpr std::uint64_t plenty = 1ull << 40;

Cycle cycle(const std::vector<ClusterId>& clusters, const VisibilityCost& cost, TourOrder order,
            std::uint64_t seed = 1) {
  const std::vector<double> no_power(cost.graph().size(), 0.0);
  return Cycle(make_order(order, seed, cost.graph(), no_power)->arrange(clusters, cost), cost);
}

/// The cheapest closed tour, by trying all.
std::uint64_t optimum(std::vector<ClusterId> clusters, const VisibilityCost& cost) {
  std::uint64_t best = ~std::uint64_t{0};
  std::sort(clusters.begin(), clusters.end());
  do {
    best = std::min(best, test::round_cost(clusters, cost));
  } while (std::next_permutation(clusters.begin() + 1, clusters.end()));
  return best;
}

TEST(Cycle, VisitsEveryClusterOnce) {
  for (std::uint32_t n : {1u, 2u, 3u, 4u, 5u, 9u, 40u, 300u}) {
    const ClusterGraph graph = test::random_graph(n, 0.2, n);
    const VisibilityCost cost(graph, test::random_bytes(n, 1), plenty);
    for (const char* const name : order_names()) {
      const TourOrder order = tour_order(name);
      const Cycle c = cycle(test::all_clusters(graph), cost, order);
      auto sorted = c.order();
      std::sort(sorted.begin(), sorted.end());
      EXPECT_EQ(sorted, test::all_clusters(graph));
      EXPECT_EQ(c.cost_bytes(), test::round_cost(c.order(), cost));
    }
  }
  const ClusterGraph nothing(0, {});
  const VisibilityCost free_of_charge(nothing, {}, 1);
  EXPECT_TRUE(cycle({}, free_of_charge, TourOrder::travelling_salesman).order().empty());
}

TEST(Cycle, VisitsASubsetOfTheGraph) {
  const ClusterGraph graph = test::shuffled_rooms(10, 10, 2);
  const VisibilityCost cost(graph, test::random_bytes(100, 1), plenty);
  std::vector<ClusterId> mine;
  for (std::uint32_t i = 99; i > 3; i -= 3) mine.emplace_back(i);
  auto order = cycle(mine, cost, TourOrder::travelling_salesman).order();
  EXPECT_TRUE(std::is_permutation(order.begin(), order.end(), mine.begin(), mine.end()));
}

TEST(Cycle, IsNearTheOptimumOfSmallInstances) {
  double sum = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const ClusterGraph graph = test::random_graph(8, 0.4, seed);
    const VisibilityCost cost(graph, test::random_bytes(8, seed), plenty);
    const auto clusters = test::all_clusters(graph);
    const double ratio =
        static_cast<double>(cycle(clusters, cost, TourOrder::travelling_salesman).cost_bytes()) /
        static_cast<double>(optimum(clusters, cost));
    EXPECT_GE(ratio, 1.0);
    EXPECT_LE(ratio, 1.1) << "seed " << seed;
    sum += ratio;
  }
  EXPECT_LE(sum / 30, 1.01);
}

TEST(Cycle, IsNearTheOptimumWhenMemoryIsTight) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const ClusterGraph graph = test::random_graph(8, 0.5, seed);
    const VisibilityCost cost(graph, test::random_bytes(8, seed), 12000);
    const auto clusters = test::all_clusters(graph);
    EXPECT_LE(
        static_cast<double>(cycle(clusters, cost, TourOrder::travelling_salesman).cost_bytes()),
        1.05 * static_cast<double>(optimum(clusters, cost)));
  }
}

TEST(Cycle, NeverCostsMoreThanItsRivals) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const ClusterGraph graph =
        seed % 2 ? test::shuffled_rooms(12, 8, seed) : test::random_graph(96, 0.1, seed);
    const VisibilityCost cost(graph, test::random_bytes(graph.size(), seed), plenty);
    const auto clusters = test::all_clusters(graph);
    const auto best = cycle(clusters, cost, TourOrder::travelling_salesman, seed).cost_bytes();
    for (TourOrder rival :
         {TourOrder::greedy, TourOrder::random, TourOrder::input, TourOrder::backtracking}) {
      EXPECT_LE(best, cycle(clusters, cost, rival, seed).cost_bytes()) << "seed " << seed;
    }
  }
}

TEST(Cycle, GoesThroughABuildingRoomByRoom) {
  // Rooms whose clusters see their own room only: entering each room once is the least there is.
  test::Pairs pairs;
  for (std::uint32_t a = 0; a < 120; ++a) {
    for (std::uint32_t b = a + 1; b < 120; ++b) {
      if (a % 12 == b % 12) pairs.emplace_back(a, b);
    }
  }
  const ClusterGraph graph(120, pairs);
  const VisibilityCost cost(graph, std::vector<std::uint64_t>(120, 7), plenty);
  EXPECT_EQ(cycle(test::all_clusters(graph), cost, TourOrder::travelling_salesman).cost_bytes(),
            120u * 7u);
}

TEST(Cycle, IsCheapestForThousandsOfClustersAndRepeatable) {
  const ClusterGraph graph = test::shuffled_rooms(300, 10, 1);
  const VisibilityCost cost(graph, test::random_bytes(graph.size(), 1), plenty);
  const auto clusters = test::all_clusters(graph);
  const auto best = cycle(clusters, cost, TourOrder::travelling_salesman);
  EXPECT_LT(best.cost_bytes(), cycle(clusters, cost, TourOrder::greedy).cost_bytes());
  EXPECT_EQ(best.order(), cycle(clusters, cost, TourOrder::travelling_salesman).order());
}

TEST(Cycle, RemoveLinksPredecessorToSuccessor) {
  const ClusterGraph graph = test::random_graph(20, 0.3, 5);
  const VisibilityCost cost(graph, test::random_bytes(20, 5), plenty);
  Cycle c = cycle(test::all_clusters(graph), cost, TourOrder::travelling_salesman);
  for (std::size_t at : {std::size_t{19}, std::size_t{0}, std::size_t{7}}) {
    auto expected = c.order();
    const ClusterId given = expected[at];
    expected.erase(expected.begin() + static_cast<std::ptrdiff_t>(at));
    c.remove(given, cost);
    EXPECT_EQ(c.order(), expected);
    EXPECT_EQ(c.cost_bytes(), test::round_cost(c.order(), cost));
    c.remove(given, cost);  // gone already
    EXPECT_EQ(c.order(), expected);
  }
  while (!c.order().empty()) {
    c.remove(c.order().back(), cost);
    EXPECT_EQ(c.cost_bytes(), test::round_cost(c.order(), cost));
  }
}

}  // namespace
}  // namespace enfilade
