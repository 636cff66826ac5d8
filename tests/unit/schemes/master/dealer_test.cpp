// Dealers of the schemes with a master; the tests play the slaves.
#include <gtest/gtest.h>

#include <set>

#include "schemes/master/cell_dealer.hpp"
#include "schemes/master/group_dealer.hpp"

namespace enfilade {
namespace {

/// Rooms in a row, each of which sees itself and the next; the clusters of a room have 1, 2, 3, ...
/// polygons.
Prepared row_of_rooms(std::size_t rooms, std::size_t clusters_a_room) {
  Prepared p;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::size_t i = 0; i < rooms * clusters_a_room; ++i) {
    Cluster c;
    c.id = ClusterId(i);
    c.cell = CellId(i / clusters_a_room);
    c.polygons.resize(1 + i % clusters_a_room);
    c.area_m2 = 1.0;
    p.clusters.push_back(c);
    for (std::size_t j = 0; j < i; ++j) {
      if (i / clusters_a_room - j / clusters_a_room < 2)
        pairs.emplace_back(static_cast<std::uint32_t>(j), static_cast<std::uint32_t>(i));
    }
  }
  p.graph = ClusterGraph(p.clusters.size(), pairs);
  return p;
}

GroupDealer groups(const Prepared& p, int slaves, bool steal) {
  const VisibilityCost cost(p.graph, std::vector<std::uint64_t>(p.clusters.size(), 1), 1 << 20);
  return GroupDealer(p, slaves, *make_order(TourOrder::input, 1, p.graph), cost, steal);
}

/// The slave of each gather of an iteration in which slave s requests work `speed[s - 1]` times a
/// round.
using Turns = std::vector<std::pair<int, ClusterId>>;
Turns play(Dealer& dealer, const std::vector<int>& speed) {
  Turns turns;
  std::vector<std::vector<ClusterId>> under_way(speed.size());
  std::set<int> ended;
  dealer.start();
  while (ended.size() < speed.size()) {
    for (std::size_t s = 0; s < speed.size(); ++s) {
      const Rank slave{static_cast<int>(s) + 1};
      for (int k = 0; k < speed[s] && !ended.contains(slave.value); ++k) {
        for (const ClusterId c : under_way[s]) dealer.done(slave, {c, 1.0, 10});
        under_way[s].clear();
        const auto order = dealer.next(slave);
        if (!order) break;
        if (order->gather.empty()) ended.insert(slave.value);
        under_way[s] = order->gather;
        for (const ClusterId c : order->gather) turns.emplace_back(slave.value, c);
      }
    }
  }
  return turns;
}

void expect_each_once(const Turns& turns, std::size_t clusters) {
  std::set<ClusterId> seen;
  for (const auto& [slave, cluster] : turns) seen.insert(cluster);
  EXPECT_EQ(turns.size(), clusters);
  EXPECT_EQ(seen.size(), clusters);
}

TEST(GroupDealer, GivesEachClusterOnceAndTheSameGroupsAgain) {
  const Prepared p = row_of_rooms(6, 4);
  GroupDealer dealer = groups(p, 3, true);
  const Turns first = play(dealer, {1, 1, 1}), second = play(dealer, {1, 1, 1});
  expect_each_once(first, 24);
  EXPECT_EQ(std::set(first.begin(), first.end()), std::set(second.begin(), second.end()));
  EXPECT_EQ(dealer.moved(), 0u);
}

TEST(GroupDealer, MovesGroupsToTheFasterSlave) {
  const Prepared p = row_of_rooms(6, 4);
  GroupDealer dealer = groups(p, 2, true);
  play(dealer, {1, 1});
  expect_each_once(play(dealer, {1, 9}), 24);
  EXPECT_GT(dealer.moved(), 0u);
}

TEST(GroupDealer, MovesNothingWithoutStealing) {
  const Prepared p = row_of_rooms(6, 4);
  GroupDealer dealer = groups(p, 2, false);
  const Turns first = play(dealer, {1, 1}), second = play(dealer, {1, 9});
  expect_each_once(second, 24);
  EXPECT_EQ(std::set(first.begin(), first.end()), std::set(second.begin(), second.end()));
  EXPECT_EQ(dealer.moved(), 0u);
}

TEST(GroupDealer, BearsMoreSlavesThanClusters) {
  const Prepared p = row_of_rooms(1, 2);
  GroupDealer dealer = groups(p, 5, true);
  expect_each_once(play(dealer, {1, 1, 1, 1, 1}), 2);
}

TEST(CellDealer, TakesOneCellAfterTheOther) {
  const Prepared p = row_of_rooms(5, 4);
  CellDealer dealer(p, 3, std::vector<double>(20, 0.0), 1, true);
  const Turns turns = play(dealer, {1, 1, 1});
  expect_each_once(turns, 20);
  for (std::size_t i = 0; i < 20; ++i) {
    EXPECT_EQ(turns[i].second.value / 4, turns[i / 4 * 4].second.value / 4) << "turn " << i;
  }
}

TEST(CellDealer, WaitsForTheCurrentCellAndReportsItsGathers) {
  const Prepared p = row_of_rooms(2, 1);
  CellDealer dealer(p, 2, {0.0, 0.0}, 1, true);
  dealer.start();
  const auto first = dealer.next(Rank{1});
  ASSERT_TRUE(first && first->gather.size() == 1);
  EXPECT_EQ(first->hold, first->gather) << "the cell, which is replicated with what it sees";
  EXPECT_TRUE(first->gathered.empty());
  EXPECT_FALSE(dealer.next(Rank{2})) << "the cell has no other cluster, and is under way";
  dealer.done(Rank{1}, {first->gather[0], 1.0, 1});
  const auto second = dealer.next(Rank{2});
  ASSERT_TRUE(second && second->gather.size() == 1);
  EXPECT_EQ(second->gathered, first->gather);
}

TEST(CellDealer, LaterGoesWhereMostLightWaits) {
  const Prepared p = row_of_rooms(5, 1);
  CellDealer dealer(p, 1, std::vector<double>(5, 0.0), 1, true);
  play(dealer, {1});
  dealer.start();
  std::vector<std::uint32_t> order;
  while (true) {
    const auto next = dealer.next(Rank{1});
    if (next->gather.empty()) break;
    order.push_back(next->gather[0].value);
    // Only room 3 changes, so that its neighbours have most to take.
    dealer.done(Rank{1}, {next->gather[0], next->gather[0].value == 3 ? 9.0 : 0.0, 1});
  }
  ASSERT_EQ(order.size(), 5u);
  dealer.start();
  const auto next = dealer.next(Rank{1});
  EXPECT_TRUE(next->gather[0].value >= 2 && next->gather[0].value <= 4) << next->gather[0].value;
}

TEST(CellDealer, StealsWithinTheCellUnlessStealingIsOff) {
  const Prepared p = row_of_rooms(1, 12);
  CellDealer stealing(p, 2, std::vector<double>(12, 0.0), 1, true);
  expect_each_once(play(stealing, {1, 9}), 12);
  EXPECT_GT(stealing.moved(), 0u);
  CellDealer planned(p, 2, std::vector<double>(12, 0.0), 1, false);
  expect_each_once(play(planned, {1, 9}), 12);
  EXPECT_EQ(planned.moved(), 0u);
}

}  // namespace
}  // namespace enfilade
