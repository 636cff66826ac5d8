#include "store/cluster_store.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <span>

#include "run/manifest.hpp"
#include "unit/store/rooms.hpp"

namespace enfilade {
namespace {

using store_tests::CountingMachine;
using store_tests::fresh_run;
using store_tests::Rooms;

const ClusterId zero(0u), one(1u);

std::vector<std::byte> text(const std::string& s) {
  const std::span<const std::byte> bytes = std::as_bytes(std::span(s));
  return {bytes.begin(), bytes.end()};
}

RecordCount sized(std::size_t bytes) {
  RecordCount count;
  count.bytes = bytes;
  return count;
}

void write(ClusterStore& store, ClusterId id, const std::string& patches,
           const std::string& links = "") {
  store.write(id, text(patches), sized(patches.size()), text(links), sized(links.size()));
}

/// Two ranks that share a RUN with two clusters, after write_initial.
struct ClusterStoreTest : testing::Test {
  RunLayout layout = fresh_run(testing::UnitTest::GetInstance()->current_test_info()->name());
  CountingMachine machine;
  Rooms rooms{2};
  ClusterStore a{layout, Rank{0}, 2, machine}, b{layout, Rank{1}, 2, machine};

  ClusterStoreTest() {
    for (std::size_t i = 0; i < 2; ++i) a.write_initial(rooms.state(i));
  }
  void commit(int iteration) {
    a.set_committed(iteration);
    b.set_committed(iteration);
  }
};

TEST_F(ClusterStoreTest, BeginsWithTheStateBeforeTheFirstIteration) {
  EXPECT_EQ(b.read_geometry(one).bytes, rooms.state(1).bytes_of(Section::geometry));
  EXPECT_EQ(b.read_patches(one).bytes, rooms.state(1).bytes_of(Section::patches));
  EXPECT_EQ(b.read_links(one).bytes, rooms.state(1).bytes_of(Section::links));
}

TEST_F(ClusterStoreTest, OthersSeeAnIterationOnlyWhenItIsCommitted) {
  write(a, zero, "one", "links one");
  EXPECT_EQ(a.read_patches(zero).bytes, text("one")) << "Gauss-Seidel within a rank";
  EXPECT_EQ(a.read_links(zero).bytes, text("links one"));
  const auto before = rooms.state(0).bytes_of(Section::patches);
  EXPECT_EQ(b.read_patches(zero).bytes, before) << "last iteration's values from the others";
  a.move_to_common();
  EXPECT_EQ(b.read_patches(zero).bytes, before) << "moved, but not committed";
  commit(1);
  EXPECT_EQ(b.read_patches(zero).bytes, text("one"));
  EXPECT_EQ(b.read_links(zero).bytes, text("links one"));
}

TEST_F(ClusterStoreTest, ACrashAfterSomeHaveMovedLeavesTheCommittedIterationWhole) {
  write(a, zero, "zero 1", "links zero 1");
  write(b, one, "one 1", "links one 1");
  a.move_to_common();
  b.move_to_common();
  commit(1);
  write(a, zero, "zero 2", "links zero 2");
  write(b, one, "one 2", "links one 2");
  a.move_to_common();  // and then everything dies
  ClusterStore fresh(layout, Rank{1}, 2, machine);
  fresh.set_committed(1);
  EXPECT_EQ(fresh.read_patches(zero).bytes, text("zero 1"));
  EXPECT_EQ(fresh.read_links(zero).bytes, text("links zero 1"));
  EXPECT_EQ(fresh.read_patches(one).bytes, text("one 1"));
  EXPECT_FALSE(std::filesystem::exists(RunLayout::patches(layout.local_of(Rank{1}), one, Slot::a)))
      << "what was never moved is gone";
}

TEST_F(ClusterStoreTest, LinksThatDidNotChangeStayWhereTheyAre) {
  write(a, zero, "p1", "links");
  a.move_to_common();
  commit(1);
  const std::uint64_t before = machine.local_written;
  for (int iteration = 2; iteration <= 5; ++iteration) {
    write(a, zero, "p" + std::to_string(iteration));
    a.move_to_common();
    commit(iteration);
    EXPECT_EQ(b.read_patches(zero).bytes, text("p" + std::to_string(iteration)));
    EXPECT_EQ(b.read_links(zero).bytes, text("links"));
  }
  EXPECT_EQ(machine.local_written - before, 4u * 2u);
}

TEST_F(ClusterStoreTest, AStolenClusterIsWrittenAndMovedByItsThief) {
  b.read_patches(zero);
  write(b, zero, "by b", "links by b");
  b.move_to_common();
  commit(1);
  EXPECT_EQ(a.read_patches(zero).bytes, text("by b"));
  EXPECT_EQ(a.read_links(zero).bytes, text("links by b"));
}

TEST_F(ClusterStoreTest, CountsWhatItMoves) {
  const std::uint64_t read = b.read_patches(one).bytes.size();
  EXPECT_EQ(b.count().bytes_read, read);
  EXPECT_EQ(machine.common_read, read);
  write(b, one, "12345", "123");
  EXPECT_EQ(b.count().bytes_written, 8u);
  EXPECT_EQ(machine.local_written, 8u);
  EXPECT_EQ(machine.common_written, 0u);
  b.move_to_common();
  EXPECT_EQ(machine.moves, 2u);
}

}  // namespace
}  // namespace enfilade
