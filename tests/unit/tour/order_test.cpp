#include "tour/order.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "unit/tour/tour_costs.hpp"

namespace enfilade {
namespace {

constexpr std::uint64_t enough_memory = 1ull << 40;

TEST(Order, KnowsItsNames) {
  for (const char* const name : order_names()) EXPECT_STREQ(name_of(tour_order(name)), name);
  EXPECT_EQ(tour_order("travelling-salesman"), TourOrder::travelling_salesman);
  EXPECT_EQ(tour_order("unshot-energy"), TourOrder::unshot_energy);
  EXPECT_THROW(tour_order("fastest"), InputError);
}

std::vector<std::uint32_t> backtracked(const ClusterGraph& graph,
                                       const std::vector<ClusterId>& clusters) {
  const VisibilityCost cost(graph, std::vector<std::uint64_t>(graph.size(), 1), enough_memory);
  std::vector<std::uint32_t> numbers;
  for (const ClusterId c : make_order(TourOrder::backtracking, 1, graph)->arrange(clusters, cost)) {
    numbers.push_back(c.value);
  }
  return numbers;
}

TEST(Backtracking, GoesDepthFirstAndComesBack) {
  // A comb: the spine 0-1-2, a tooth at each end and two at the middle; 7 is seen by nobody.
  const ClusterGraph graph(8, {{0, 1}, {1, 2}, {0, 3}, {1, 4}, {1, 5}, {2, 6}});
  const auto order = backtracked(graph, test::all_clusters(graph));
  // 0 -> its tooth, which costs nothing more, back; on to 1 and its teeth, back; 2, 6; at last 7.
  EXPECT_EQ(order, (std::vector<std::uint32_t>{0, 3, 1, 4, 5, 2, 6, 7}));
}

TEST(Backtracking, LeavesOutClustersOfOtherRanks) {
  const ClusterGraph graph(4, {{0, 1}, {1, 2}, {2, 3}});
  EXPECT_EQ(backtracked(graph, {ClusterId(0), ClusterId(2), ClusterId(3)}),
            (std::vector<std::uint32_t>{0, 2, 3}));
}

TEST(UnshotEnergy, ChoosesTheClusterWithMostUnshotEnergy) {
  // A chain of rooms with the lamp in the last.
  const ClusterGraph graph(4, {{0, 1}, {1, 2}, {2, 3}});
  const auto order = make_order(TourOrder::unshot_energy, 1, graph, {0, 0, 0, 10});
  std::vector<ClusterId> waiting = test::all_clusters(graph);
  EXPECT_EQ(order->choose(waiting), 2u) << "3 and 2 see the lamp; of equals the first";
  waiting.erase(waiting.begin() + 2);
  order->gathered(ClusterId(2), 5.0);
  EXPECT_EQ(order->choose(waiting), 2u) << "15 wait for 3, 5 for 1";
  waiting.pop_back();
  order->gathered(ClusterId(3), 1.0);
  EXPECT_EQ(order->choose(waiting), 1u) << "nothing has come near 0";
  order->gathered(ClusterId(1), 0.0);
  EXPECT_EQ(order->choose(waiting), 0u) << "what waited for 1 is taken";
}

}  // namespace
}  // namespace enfilade
