#include "schemes/spmd/task_list.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace enfilade {
namespace {

using ::testing::ElementsAre;

/// A chain of clusters: each sees the one before and the one after.
ClusterGraph chain(std::uint32_t n) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::uint32_t i = 0; i + 1 < n; ++i) pairs.emplace_back(i, i + 1);
  return ClusterGraph(n, pairs);
}

std::vector<ClusterId> ids(std::initializer_list<std::uint32_t> values) {
  std::vector<ClusterId> result;
  for (const auto v : values) result.emplace_back(v);
  return result;
}

struct TaskListTest : testing::Test {
  ClusterGraph graph = chain(12);
  VisibilityCost cost{graph, std::vector<std::uint64_t>(12, 100), 1 << 20};
  TaskList tasks{ids({0, 1, 2, 3, 4, 5}), cost, make_order(TourOrder::input, 1, graph)};
};

TEST_F(TaskListTest, HasNothingToDoBeforeItStarts) {
  EXPECT_EQ(tasks.waiting(), 0u);
  EXPECT_FALSE(tasks.next());
  EXPECT_FALSE(tasks.give(ids({1})));
}

TEST_F(TaskListTest, GoesThroughCycleOnceAnIteration) {
  for (int iteration = 0; iteration < 2; ++iteration) {
    tasks.start();
    std::vector<ClusterId> seen;
    while (const auto c = tasks.next()) seen.push_back(*c);
    EXPECT_EQ(seen, ids({0, 1, 2, 3, 4, 5}));
  }
}

TEST_F(TaskListTest, GivesWhatCostsTheThiefLeast) {
  tasks.start();
  EXPECT_EQ(tasks.next(), ClusterId(0u));
  EXPECT_EQ(tasks.give(ids({2, 3, 4})), ClusterId(3u));
  EXPECT_EQ(tasks.give(ids({6, 7, 8})), ClusterId(5u));
  // What is given is gone for good, what was done is not given.
  EXPECT_THAT(tasks.cycle().order(),
              ElementsAre(ClusterId(0u), ClusterId(1u), ClusterId(2u), ClusterId(4u)));
  EXPECT_EQ(tasks.waiting(), 3u);
  while (tasks.next()) {
  }
  EXPECT_FALSE(tasks.give(ids({0})));
}

TEST_F(TaskListTest, KeepsWhatItStoleWhereItFitsBest) {
  tasks.start();
  tasks.adopt(ClusterId(11u));
  tasks.adopt(ClusterId(6u));
  EXPECT_EQ(tasks.waiting(), 6u) << "a stolen cluster is gathered at once, not from CYCLE";
  tasks.start();
  const auto& order = tasks.cycle().order();
  EXPECT_EQ(std::set<ClusterId>(order.begin(), order.end()).size(), 8u);
  const auto six = std::find(order.begin(), order.end(), ClusterId(6u)) - order.begin();
  const auto five = std::find(order.begin(), order.end(), ClusterId(5u)) - order.begin();
  EXPECT_EQ(std::abs(six - five), 1) << "6 sees 5: between its neighbours it loads least";
}

TEST_F(TaskListTest, TakesTheTurnThatTheOrderChooses) {
  std::vector<double> emitted(12, 0.0);
  emitted[5] = 10.0;
  TaskList lit(ids({0, 1, 2, 3, 4, 5}), cost,
               make_order(TourOrder::unshot_energy, 1, graph, emitted));
  lit.start();
  EXPECT_EQ(lit.next(), ClusterId(4u)) << "4 and 5 see the lamp; of equals the first";
  lit.gathered(ClusterId(4u), 3.0);
  EXPECT_EQ(lit.next(), ClusterId(5u));
  lit.gathered(ClusterId(5u), 1.0);
  EXPECT_EQ(lit.next(), ClusterId(3u)) << "3 sees what 4 received";
  lit.gathered(ClusterId(3u), 1.0);
  EXPECT_EQ(lit.give(ids({0})), ClusterId(0u));
  std::vector<ClusterId> rest;
  while (const auto c = lit.next()) rest.push_back(*c);
  EXPECT_EQ(rest, ids({2, 1})) << "each once, and what was given is gone";
}

TEST_F(TaskListTest, KnowsWhenAClusterIsUsedNext) {
  tasks.start();
  tasks.next();
  tasks.next();  // 0 and 1 are done; 2 is next
  EXPECT_EQ(tasks.next_use(ClusterId(3u), false), 0u) << "2 sees it";
  EXPECT_EQ(tasks.next_use(ClusterId(3u), true), 1u) << "its links wait for its own turn";
  EXPECT_EQ(tasks.next_use(ClusterId(6u), false), 3u) << "5 sees it";
  EXPECT_EQ(tasks.next_use(ClusterId(0u), true), 4u) << "in the next round";
  EXPECT_GT(tasks.next_use(ClusterId(10u), false), 12u) << "nobody here sees it";
}

}  // namespace
}  // namespace enfilade
