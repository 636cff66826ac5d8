#include "run/sections/segment_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
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
  const SegmentIndex index(directory, patches_3, 3);
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
  EXPECT_THROW(SegmentIndex(directory, patches_3, 6), RunError) << "it has no table yet";
}

TEST_F(SegmentFileTest, SegmentsOfOtherIterationsAndRunsAreNotBelieved) {
  SegmentKind older = patches_3, other = patches_3;
  older.iteration = 1;
  other.run = 98;
  write(Rank{0}, {0});
  write(Rank{1}, {1}, older);
  write(Rank{2}, {1}, other);
  const SegmentIndex index(directory, patches_3, 2);
  EXPECT_NO_THROW(index.read(ClusterId(0u)));
  EXPECT_THROW(index.read(ClusterId(1u)), RunError);
}

TEST_F(SegmentFileTest, AShorterSegmentOverALongerOneIsWhole) {
  write(Rank{0}, {0, 1, 2, 3});
  write(Rank{0}, {1});
  const SegmentIndex index(directory, patches_3, 4);
  EXPECT_NO_THROW(index.read(ClusterId(1u)));
  EXPECT_THROW(index.at(ClusterId(0u)), RunError);
}

TEST_F(SegmentFileTest, AnyDamagedByteIsFound) {
  write(Rank{0}, {0, 1});
  const std::string path = segment_path(directory, patches_3.name, Rank{0}, 0);
  const std::vector<std::byte> good = read_file(path);
  const auto read_all = [&] {
    const SegmentIndex index(directory, patches_3, 2);
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

TEST_F(SegmentFileTest, OnlySegmentsAreRemoved) {
  write(Rank{0}, {0});
  SegmentKind links{"links-2", Section::links, 2, 99};
  write(Rank{1}, {0}, links);
  for (const char* name : {"manifest.json", "rank-0", "rank-x.patches-b.0", "rank-0.patches-b.x"})
    write_file(directory + "/" + name, some_bytes(3, 0), {});
  remove_segments(directory, "patches-b");
  EXPECT_FALSE(fs::exists(segment_path(directory, "patches-b", Rank{0}, 0)));
  EXPECT_TRUE(fs::exists(segment_path(directory, "links-2", Rank{1}, 0)));
  remove_segments(directory);
  EXPECT_EQ(std::distance(fs::directory_iterator(directory), fs::directory_iterator()), 4);
}

}  // namespace
}  // namespace enfilade
