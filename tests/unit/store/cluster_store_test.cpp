#include "store/cluster_store.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <span>
#include <string>

#include "run/manifest.hpp"
#include "unit/store/rooms.hpp"

namespace enfilade {
namespace {

using store_tests::CountingMachine;
using store_tests::fresh_run;
using store_tests::Rooms;

const ClusterId cluster_a(0u), cluster_b(1u);

std::vector<std::byte> text(const std::string& s) {
  const std::span<const std::byte> bytes = std::as_bytes(std::span(s));
  return {bytes.begin(), bytes.end()};
}

SectionFile section(ClusterId id, Section which, const std::string& content) {
  SectionFile file{{{id, which}, {}, {}}, text(content)};
  file.info.count.bytes = content.size();
  return file;
}

void write(ClusterStore& store, ClusterId id, const std::string& patches,
           const std::string& links = "") {
  std::vector<SectionFile> sections{section(id, Section::patches, patches)};
  if (!links.empty()) sections.push_back(section(id, Section::links, links));
  store.store_sections(std::move(sections));
}

std::vector<std::byte> read(ClusterStore& store, ClusterId id, Section which) {
  return store.load_section({id, which}).bytes;
}

/// Two ranks that share a RUN with two clusters, after write_initial.
struct ClusterStoreTest : testing::Test {
  RunLayout layout = fresh_run(testing::UnitTest::GetInstance()->current_test_info()->name());
  CountingMachine machine;
  Rooms rooms{2};
  ClusterStore a{layout, 5, Rank{0}, 2, 2, machine}, b{layout, 5, Rank{1}, 2, 2, machine};

  ClusterStoreTest() {
    for (std::size_t i = 0; i < 2; ++i) a.write_initial(rooms.state(i));
    a.end_initial();
  }
  void commit(int iteration) {
    a.set_committed(iteration);
    b.set_committed(iteration);
  }
};

TEST_F(ClusterStoreTest, BeginsWithTheStateBeforeTheFirstIteration) {
  EXPECT_EQ(read(b, cluster_b, Section::geometry), rooms.state(1).bytes_of(Section::geometry));
  EXPECT_EQ(read(b, cluster_b, Section::patches), rooms.state(1).bytes_of(Section::patches));
  EXPECT_EQ(read(b, cluster_b, Section::links), rooms.state(1).bytes_of(Section::links));
}

TEST_F(ClusterStoreTest, OthersSeeAnIterationOnlyWhenItIsCommitted) {
  write(a, cluster_a, "one", "links one");
  EXPECT_EQ(read(a, cluster_a, Section::patches), text("one")) << "Gauss-Seidel within a rank";
  EXPECT_EQ(read(a, cluster_a, Section::links), text("links one"));
  const auto before = rooms.state(0).bytes_of(Section::patches);
  EXPECT_EQ(read(b, cluster_a, Section::patches), before)
      << "last iteration's values from the others";
  a.move_to_common();
  EXPECT_EQ(read(b, cluster_a, Section::patches), before) << "moved, but not committed";
  commit(1);
  EXPECT_EQ(read(b, cluster_a, Section::patches), text("one"));
  EXPECT_EQ(read(b, cluster_a, Section::links), text("links one"));
}

TEST_F(ClusterStoreTest, ACrashAfterSomeHaveMovedLeavesTheCommittedIterationWhole) {
  write(a, cluster_a, "zero 1", "links zero 1");
  write(b, cluster_b, "one 1", "links one 1");
  a.move_to_common();
  b.move_to_common();
  commit(1);
  write(a, cluster_a, "zero 2", "links zero 2");
  write(b, cluster_b, "one 2", "links one 2");
  a.move_to_common();  // and then everything dies
  ClusterStore fresh(layout, 5, Rank{1}, 2, 2, machine);
  fresh.set_committed(1);
  EXPECT_EQ(read(fresh, cluster_a, Section::patches), text("zero 1"));
  EXPECT_EQ(read(fresh, cluster_a, Section::links), text("links zero 1"));
  EXPECT_EQ(read(fresh, cluster_b, Section::patches), text("one 1"));
  EXPECT_TRUE(std::filesystem::is_empty(layout.local_of(Rank{1})))
      << "what was never moved is gone";
}

TEST_F(ClusterStoreTest, LinksThatDidNotChangeStayWhereTheyAre) {
  write(a, cluster_a, "p1", "links");
  a.move_to_common();
  commit(1);
  const std::uint64_t before = machine.local_written;
  for (int iteration = 2; iteration <= 5; ++iteration) {
    write(a, cluster_a, "p" + std::to_string(iteration));
    a.move_to_common();
    commit(iteration);
    EXPECT_EQ(read(b, cluster_a, Section::patches), text("p" + std::to_string(iteration)));
    EXPECT_EQ(read(b, cluster_a, Section::links), text("links"));
  }
  EXPECT_EQ(machine.local_written - before, 4u * 2u);
}

TEST_F(ClusterStoreTest, AStolenClusterIsWrittenAndMovedByItsThief) {
  read(b, cluster_a, Section::patches);
  write(b, cluster_a, "by b", "links by b");
  b.move_to_common();
  commit(1);
  EXPECT_EQ(read(a, cluster_a, Section::patches), text("by b"));
  EXPECT_EQ(read(a, cluster_a, Section::links), text("links by b"));
}

/// The names of the files in the common directory that hold links.
std::set<std::string> link_files(const RunLayout& layout) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(layout.common())) {
    const std::string name = entry.path().filename().string();
    if (name.find("links") != std::string::npos) names.insert(name);
  }
  return names;
}

TEST_F(ClusterStoreTest, LinksThatNoClusterNeedsAnyMoreAreRemoved) {
  for (int iteration = 1; iteration <= 2; ++iteration) {
    write(a, cluster_a, "p", "links of a");
    write(b, cluster_b, "p", iteration == 1 ? "links of b" : "");
    a.move_to_common();
    b.move_to_common();
    commit(iteration);
  }
  EXPECT_EQ(link_files(layout), (std::set<std::string>{"rank-0.links-2.0", "rank-1.links-1.0"}));
  read(a, cluster_b, Section::patches);  // they say where the links lie
  EXPECT_EQ(read(a, cluster_b, Section::links), text("links of b"));
}

TEST_F(ClusterStoreTest, LinksOfARankThatIsAheadStay) {
  write(a, cluster_a, "1", "l");
  write(b, cluster_b, "1", "l");
  a.move_to_common();
  b.move_to_common();
  b.set_committed(1);
  write(b, cluster_b, "2", "links 2");
  b.move_to_common();
  a.set_committed(1);
  EXPECT_TRUE(link_files(layout).contains("rank-1.links-2.0"));
}

TEST_F(ClusterStoreTest, ARankThatGathersForNoneLeavesTheFilesOfOthersAlone) {
  write(b, cluster_a, "1", "l");
  write(b, cluster_b, "1", "l");
  b.move_to_common();
  commit(1);
  for (int iteration = 2; iteration <= 3; ++iteration) {
    for (const ClusterId id : {cluster_a, cluster_b}) read(a, id, Section::patches);
    write(a, cluster_a, std::to_string(iteration));
    write(a, cluster_b, std::to_string(iteration));
    a.move_to_common();
    b.move_to_common();
    commit(iteration);
  }
  // rank-1.patches-b holds iteration 1, rank-0.patches-b iteration 3.
  EXPECT_EQ(read(b, cluster_a, Section::patches), text("3"));
  EXPECT_EQ(read(b, cluster_b, Section::links), text("l"));
}

TEST_F(ClusterStoreTest, CountsWhatItMoves) {
  const std::uint64_t bytes = read(b, cluster_b, Section::patches).size();
  EXPECT_EQ(b.count().bytes_read, bytes);
  EXPECT_EQ(machine.common_read, bytes);
  write(b, cluster_b, "12345", "123");
  EXPECT_EQ(b.count().bytes_written, 8u);
  EXPECT_EQ(machine.local_written, 8u);
  EXPECT_EQ(machine.common_written, 0u);
  b.move_to_common();
  EXPECT_EQ(machine.moves, 2u);
}

}  // namespace
}  // namespace enfilade
