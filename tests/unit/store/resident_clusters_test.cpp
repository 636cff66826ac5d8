#include "store/resident_clusters.hpp"

#include <gtest/gtest.h>

#include "store/cluster_store.hpp"
#include "unit/store/rooms.hpp"

namespace enfilade {
namespace {

using store_tests::CountingMachine;
using store_tests::fresh_run;
using store_tests::MemorySource;
using store_tests::Rooms;

ClusterId id(std::size_t i) { return ClusterId(i); }

struct ResidentClustersTest : testing::Test {
  RunLayout layout = fresh_run(testing::UnitTest::GetInstance()->current_test_info()->name());
  CountingMachine machine;
  Rooms rooms{6};
  ClusterStore store{layout, 0, Rank{0}, 2, 6, machine};

  ResidentClustersTest() {
    for (std::size_t i = 0; i < 6; ++i) store.write_initial(rooms.state(i));
    store.end_initial();
  }
  /// Bytes that one of the clusters takes where there is a budget.
  std::uint64_t size() {
    ResidentClusters one(store, machine, 1 << 30);
    one.pin_shooter(id(0));
    return one.bytes();
  }
};

TEST_F(ResidentClustersTest, WithoutPressureNothingIsReadTwice) {
  ResidentClusters resident(store, machine, 0);
  for (int round = 0; round < 3; ++round) {
    for (std::size_t i = 0; i < 6; ++i) resident.pin_shooter(id(i));
    resident.unpin();
  }
  EXPECT_EQ(resident.count().loads, 6u);
  EXPECT_EQ(resident.count().hits, 12u);
  EXPECT_EQ(resident.resident().size(), 6u);
}

TEST_F(ResidentClustersTest, OwnGathersStayOthersAreReadAgain) {
  ResidentClusters resident(store, machine, 0);
  resident.pin_receiver(id(0)).patches().radiosity(0)[0] = 42.0;
  resident.pin_shooter(id(1));
  resident.write_receiver(id(0), false);
  resident.unpin();
  store.move_to_common();
  // Another rank has gathered for cluster 1 meanwhile.
  CountingMachine elsewhere;
  ClusterStore other(layout, 0, Rank{1}, 2, 6, elsewhere);
  ResidentClusters others(other, elsewhere, 0);
  others.pin_receiver(id(1)).patches().radiosity(0)[0] = 43.0;
  others.write_receiver(id(1), false);
  other.move_to_common();
  store.set_committed(1);

  const std::uint64_t loads = resident.count().loads;
  EXPECT_EQ(resident.pin_shooter(id(0)).patches().radiosity(0)[0], 42.0);
  EXPECT_EQ(resident.count().loads, loads);
  EXPECT_EQ(resident.pin_shooter(id(1)).patches().radiosity(0)[0], 43.0);
  EXPECT_EQ(resident.count().loads, loads + 1);
}

TEST_F(ResidentClustersTest, LinksAreWrittenOnlyWhereTheGatherChangedThem) {
  ResidentClusters resident(store, machine, 0);
  const auto written_bytes = [&](bool links_changed) {
    const std::uint64_t before = machine.local_written;
    ClusterState& state = resident.pin_receiver(id(0));
    state.links().add({}, std::vector<float>(state.links().stride(), 0.0f));
    const WrittenReceiver written = resident.write_receiver(id(0), links_changed);
    resident.unpin();
    EXPECT_EQ(written.links.file_bytes > 0, links_changed);
    EXPECT_EQ(written.patches.file_bytes + written.links.file_bytes,
              machine.local_written - before);
    return written.links.file_bytes;
  };
  EXPECT_EQ(written_bytes(false), 0u);
  EXPECT_GT(written_bytes(true), 0u);
}

TEST(ResidentClusters, AreServedFromMemoryWithoutAnyBytes) {
  const Rooms rooms(3);
  CountingMachine machine;
  MemorySource source(rooms, 3);
  ResidentClusters resident(source, machine, 1);  // room for nothing
  resident.set_jacobi(true);
  ClusterState& receiver = resident.pin_receiver(id(0));
  receiver.links().add({}, std::vector<float>(receiver.links().stride(), 0.0f));
  receiver.patches().radiosity(0)[0] = 42.0;
  const double committed = rooms.state(0).patches().radiosity(0)[0];
  EXPECT_EQ(resident.write_receiver(id(0), true).patches.file_bytes, 0u);
  EXPECT_EQ(resident.pin_shooter(id(0)).patches().radiosity(0)[0], committed);
  resident.unpin();
  resident.set_jacobi(false);
  EXPECT_EQ(resident.pin_shooter(id(0)).patches().radiosity(0)[0], 42.0);
  resident.unpin();
  EXPECT_EQ(resident.pin_receiver(id(0)).links().size(), 1u);
  EXPECT_EQ(machine.common_read + machine.local_written, 0u);
}

TEST_F(ResidentClustersTest, UnderPressureTheFarthestNextUseGoesFirst) {
  ResidentClusters resident(store, machine, 4 * size() + size() / 2);  // three, and room for one
  const std::vector<std::uint64_t> next_use = {5, 9, 1, 7, 3, 2};
  resident.set_next_use([&](ClusterId c, bool) { return next_use[c.index()]; });
  for (std::size_t i = 0; i < 4; ++i) {
    resident.pin_shooter(id(i));
    resident.unpin();
  }
  EXPECT_EQ(resident.resident(), (std::vector<ClusterId>{id(0), id(2), id(3)}));
  resident.pin_shooter(id(4));
  resident.unpin();
  EXPECT_EQ(resident.resident(), (std::vector<ClusterId>{id(0), id(2), id(4)}));
  EXPECT_LE(resident.bytes(), 3 * size() + size() / 2);
  EXPECT_LE(resident.count().peak_bytes, 4 * size() + size() / 2);
  EXPECT_EQ(resident.count().over_budget_bytes, 0u) << "what comes in has room before others go";
  // The memory is no whole number of pages.
  EXPECT_LE(resident.count().placement.swapped_bytes, SimulatedPlacement::page_bytes);
}

TEST_F(ResidentClustersTest, WhatIsEvictedComesBackAsItWas) {
  ResidentClusters resident(store, machine, 1);  // room for nothing
  for (std::size_t i = 0; i < 6; ++i) {
    ClusterState& state = resident.pin_receiver(id(i));
    state.patches().subdivide(0);
    state.patches().radiosity(0)[0] = 100.0 + static_cast<double>(i);
    resident.write_receiver(id(i), false);
    resident.unpin();
    EXPECT_TRUE(resident.resident().empty());
  }
  for (std::size_t i = 0; i < 6; ++i) {
    const ClusterState& state = resident.pin_receiver(id(i));
    EXPECT_EQ(state.patches().size(), 3u);
    EXPECT_EQ(state.patches().radiosity(0)[0], 100.0 + static_cast<double>(i));
    resident.unpin();
  }
  EXPECT_GT(resident.count().over_budget_bytes, 0u)
      << "a gather that needs more than there is says so";
}

TEST_F(ResidentClustersTest, TheReceiverAndTheShooterAtHandStayWhateverTheBudget) {
  ResidentClusters resident(store, machine, 1);
  const ClusterState& first = resident.pin_receiver(id(0));
  for (std::size_t i = 1; i < 6; ++i) {
    EXPECT_EQ(resident.pin_shooter(id(i)).id(), id(i));
    EXPECT_EQ(resident.resident(), (std::vector<ClusterId>{id(0), id(i)}));
  }
  EXPECT_EQ(first.id(), id(0));
  resident.unpin();
  EXPECT_TRUE(resident.resident().empty());
}

TEST_F(ResidentClustersTest, WhatIsHeldStaysUntilSomethingElseIs) {
  ResidentClusters resident(store, machine, 1);
  resident.hold({id(4), id(1), id(4)});
  EXPECT_EQ(resident.resident(), (std::vector<ClusterId>{id(1), id(4)}));
  resident.pin_receiver(id(0));
  resident.pin_shooter(id(1));
  resident.unpin();
  EXPECT_EQ(resident.resident(), (std::vector<ClusterId>{id(1), id(4)}));
  EXPECT_EQ(resident.count().hits, 1u) << "what is held is not read again";
  resident.hold({id(1), id(2)});
  EXPECT_EQ(resident.resident(), (std::vector<ClusterId>{id(1), id(2)}));
  resident.hold({});
  EXPECT_TRUE(resident.resident().empty());
}

TEST_F(ResidentClustersTest, ShootersStillToComeStayLongerThanThoseUsedSooner) {
  // Room for four, and for one that comes in. Clusters 3 and 4 are in memory and still to come in
  // this gather; 1 and 2, which the next gather needs, go before them.
  ResidentClusters resident(store, machine, 5 * size() + size() / 2);
  resident.set_next_use([&](ClusterId c, bool) { return c.index() < 3 ? 0u : 9u; });
  resident.pin_shooter(id(4));
  resident.pin_shooter(id(3));
  resident.unpin();
  const std::vector<ClusterId> visible = {id(0), id(1), id(2), id(3), id(4)};
  resident.pin_receiver(id(0), visible);
  for (std::size_t i = 1; i < 5; ++i) resident.pin_shooter(id(i));
  EXPECT_EQ(resident.count().hits, 2u);
  EXPECT_EQ(resident.count().loads, 5u);
}

}  // namespace
}  // namespace enfilade
