#include "run/sections/segment_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>

#include "base/error.hpp"
#include "base/posix_file.hpp"

namespace enfilade {
namespace {

namespace fs = std::filesystem;

const SegmentKind patches_3{"patches-b", Section::patches, 3, 99};

std::vector<std::byte> some_bytes(std::size_t n, int first) {
  std::vector<std::byte> bytes(n);
  for (std::size_t i = 0; i < n; ++i)
    bytes[i] = static_cast<std::byte>(first + static_cast<int>(i));
  return bytes;
}

SectionInfo info_of(std::uint32_t cluster, const SegmentKind& kind = patches_3) {
  SectionInfo info;
  info.place = {ClusterId(cluster), kind.section, kind.iteration, kind.run};
  info.links = {cluster, {Rank{1}, 0, cluster}};
  return info;
}

struct SegmentFileTest : testing::Test {
  std::string directory = testing::TempDir() + "/segments";
  SegmentFileTest() {
    fs::remove_all(directory);
    fs::create_directories(directory);
  }
  ~SegmentFileTest() override { fs::remove_all(directory); }

  void write(Rank rank, std::vector<std::uint32_t> clusters, const SegmentKind& kind = patches_3) {
    SegmentWriter writer(directory, kind, rank);
    for (const std::uint32_t cluster : clusters)
      writer.put(info_of(cluster, kind), some_bytes(100 + cluster, static_cast<int>(cluster)));
    writer.end();
  }
};

TEST_F(SegmentFileTest, TheIndexFindsTheSectionsOfAllRanks) {
  write(Rank{0}, {2, 0});
  write(Rank{11}, {1});
  const SegmentIndex index(directory, patches_3, 3, 12);
  for (const std::uint32_t cluster : {0u, 1u, 2u}) {
    const SectionFile file = index.read(ClusterId(cluster));
    EXPECT_EQ(file.bytes, some_bytes(100 + cluster, static_cast<int>(cluster)));
    EXPECT_EQ(index.at(ClusterId(cluster)).links, info_of(cluster).links);
    EXPECT_EQ(file.info.links, info_of(cluster).links);
  }
}

TEST_F(SegmentFileTest, WhatWasPutCanBeReadBeforeTheSegmentEnds) {
  SegmentWriter writer(directory, patches_3, Rank{0});
  writer.put(info_of(4), some_bytes(10, 4));
  const SegmentPlace at = writer.put(info_of(5), some_bytes(20, 5));
  EXPECT_EQ(writer.get(at, info_of(5).place).bytes, some_bytes(20, 5));
  EXPECT_THROW(SegmentIndex(directory, patches_3, 6, 1), RunError) << "it has no table yet";
}

TEST_F(SegmentFileTest, SegmentsOfOtherIterationsAndRunsAreNotBelieved) {
  SegmentKind older = patches_3, other = patches_3;
  older.iteration = 1;
  other.run = 98;
  write(Rank{0}, {0});
  write(Rank{1}, {1}, older);
  write(Rank{2}, {1}, other);
  const SegmentIndex index(directory, patches_3, 2, 3);
  EXPECT_NO_THROW(index.read(ClusterId(0u)));
  EXPECT_THROW(index.read(ClusterId(1u)), RunError);
}

TEST_F(SegmentFileTest, AShorterSegmentOverALongerOneIsWhole) {
  write(Rank{0}, {0, 1, 2, 3});
  write(Rank{0}, {1});
  const SegmentIndex index(directory, patches_3, 4, 1);
  EXPECT_NO_THROW(index.read(ClusterId(1u)));
  EXPECT_THROW(index.at(ClusterId(0u)), RunError);
}

TEST_F(SegmentFileTest, AnyDamagedByteIsFound) {
  write(Rank{0}, {0, 1});
  const std::string path = segment_path(directory, patches_3.name, Rank{0}, 0);
  const std::vector<std::byte> good = read_file(path);
  const auto read_all = [&] {
    const SegmentIndex index(directory, patches_3, 2, 3);
    for (const std::uint32_t cluster : {0u, 1u}) index.read(ClusterId(cluster));
  };
  EXPECT_NO_THROW(read_all());
  for (std::size_t i = 0; i < good.size(); ++i) {
    std::vector<std::byte> bad = good;
    bad[i] ^= std::byte{0x10};
    write_file(path, bad, {});
    EXPECT_THROW(read_all(), RunError) << "byte " << i;
  }
  for (std::size_t size = 0; size < good.size(); size += 7) {
    write_file(path, std::span(good).first(size), {});
    EXPECT_THROW(read_all(), RunError) << "cut at " << size;
  }
}

TEST_F(SegmentFileTest, PartsEndBeforeTheirLimit) {
  const std::vector<std::byte> bytes = some_bytes(1000, 1);
  SegmentWriter writer(directory, patches_3, Rank{0}, 2500);
  for (const std::uint32_t cluster : {0u, 1u, 2u, 3u, 4u}) writer.put(info_of(cluster), bytes);
  writer.put(info_of(5), some_bytes(5000, 2));  // larger than a part
  EXPECT_EQ(writer.get({Rank{0}, 1, 0}, info_of(2).place).bytes, bytes);
  EXPECT_EQ(writer.end(), 4u);
  for (const std::uint32_t part : {0u, 1u, 2u})
    EXPECT_LT(fs::file_size(segment_path(directory, "patches-b", Rank{0}, part)), 2500u);
  const SegmentIndex index(directory, patches_3, 6, 1);
  for (const std::uint32_t cluster : {0u, 1u, 2u, 3u, 4u})
    EXPECT_EQ(index.read(ClusterId(cluster)).bytes, bytes);
  EXPECT_EQ(index.at(ClusterId(5u)).at.part, 3u);
  EXPECT_EQ(index.read(ClusterId(5u)).bytes, some_bytes(5000, 2));
}

TEST_F(SegmentFileTest, ASectionLargerThanTheBufferComesBackAsWritten) {
  SegmentWriter writer(directory, patches_3, Rank{0});
  const std::vector<std::byte> large = some_bytes(3'000'000, 5), small = some_bytes(10, 6);
  writer.put(info_of(0), small);
  writer.put(info_of(1), large);
  writer.put(info_of(2), small);
  writer.end();
  const SegmentIndex index(directory, patches_3, 3, 1);
  EXPECT_EQ(index.read(ClusterId(0u)).bytes, small);
  EXPECT_EQ(index.read(ClusterId(1u)).bytes, large);
  EXPECT_EQ(index.read(ClusterId(2u)).bytes, small);
}

TEST_F(SegmentFileTest, AClusterOfTwoRanksIsRefused) {
  write(Rank{0}, {0, 1});
  write(Rank{1}, {1});
  EXPECT_THROW(SegmentIndex(directory, patches_3, 2, 2), RunError);
}

TEST_F(SegmentFileTest, LinksGoThatNeitherACommittedClusterNorALaterIterationNeeds) {
  SegmentWriter patches(directory, patches_3, Rank{0});
  SectionInfo info = info_of(0);
  info.links = {2, {Rank{1}, 0, 0}};
  patches.put(info, some_bytes(3, 0));
  patches.end();
  for (const std::uint32_t iteration : {1u, 2u, 4u}) {
    for (const Rank rank : {Rank{0}, Rank{1}})
      write(rank, {0}, {"links-" + std::to_string(iteration), Section::links, iteration, 99});
  }
  const auto there = [&](int rank, int iteration) {
    return fs::exists(segment_path(directory, "links-" + std::to_string(iteration), Rank{rank}, 0));
  };
  const SegmentIndex index(directory, patches_3, 1, 2);
  remove_unused_links(directory, index);
  EXPECT_TRUE(there(1, 2));
  for (const int iteration : {1, 2}) EXPECT_FALSE(there(0, iteration));
  for (const int rank : {0, 1}) EXPECT_TRUE(there(rank, 4)) << "a rank that is ahead wrote it";
  fs::remove(segment_path(directory, patches_3.name, Rank{0}, 0));
  remove_unused_links(directory, SegmentIndex(directory, patches_3, 1, 2));
  EXPECT_TRUE(there(1, 2));
}

TEST_F(SegmentFileTest, WhatAKilledIterationLeftIsRemovedAndNothingElse) {
  write(Rank{0}, {0});
  write(Rank{3}, {0}, {"patches-a", Section::patches, 4, 99});
  write(Rank{3}, {0}, {"links-4", Section::links, 4, 99});
  write(Rank{3}, {0}, {"links-3", Section::links, 3, 99});
  write(Rank{3}, {0}, {"geometry", Section::geometry, 0, 99});
  for (const char* name : {"manifest.json", "rank-0", "rank-x.patches-a.0", "rank-0.patches-a.x"})
    write_file(directory + "/" + name, some_bytes(3, 0), {});
  remove_later_segments(directory, 3);
  std::set<std::string> left;
  for (const auto& entry : fs::directory_iterator(directory))
    left.insert(entry.path().filename().string());
  EXPECT_EQ(left, (std::set<std::string>{"rank-0.patches-b.0", "rank-3.links-3.0",
                                         "rank-3.geometry.0", "manifest.json", "rank-0",
                                         "rank-x.patches-a.0", "rank-0.patches-a.x"}));
}

}  // namespace
}  // namespace enfilade
