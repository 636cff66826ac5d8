#include "base/atomic_file.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>

#include "base/error.hpp"
#include "base/posix_file.hpp"

namespace enfilade {
namespace {

namespace fs = std::filesystem;

struct AtomicFileTest : testing::Test {
  fs::path folder = fs::path(testing::TempDir()) / "enfilade-atomic-file";
  std::string path = (folder / "file").string();

  AtomicFileTest() {
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  ~AtomicFileTest() override { fs::remove_all(folder); }

  static std::string content(const fs::path& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  std::size_t files() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
  }
};

TEST_F(AtomicFileTest, AppearsWhenItIsCommitted) {
  replace_file(path, "old");
  AtomicFile file(path);
  file.add("new ");
  file.add("text");
  EXPECT_EQ(content(path), "old");
  file.commit(true);
  EXPECT_EQ(content(path), "new text");
  EXPECT_EQ(files(), 1u);
}

TEST_F(AtomicFileTest, LeavesNothingWhenItIsDropped) {
  { AtomicFile(path).add("half"); }
  EXPECT_EQ(files(), 0u);
}

TEST_F(AtomicFileTest, NoLinkThatWasPlantedIsWrittenThrough) {
  const fs::path mine = folder / "mine";
  std::ofstream(mine) << "mine";
  for (const char* name : {"file", "file.new", "file.part", "file.moving"})
    fs::create_symlink(mine, folder / name);
  replace_file(path, "text");
  EXPECT_EQ(content(mine), "mine");
  EXPECT_EQ(content(path), "text");
  EXPECT_FALSE(fs::is_symlink(path));
  EXPECT_THROW(write_file((folder / "file.new").string(), {}, {}), RunError);
  EXPECT_EQ(content(mine), "mine");
}

TEST_F(AtomicFileTest, ADeviceIsWrittenToAndStays) {
  EXPECT_THROW(replace_file("/dev/full", "text"), RunError);
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
  EXPECT_NO_THROW(replace_file("/dev/null", "text"));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(AtomicFileTest, APipeIsWrittenToWhereSomebodyReadsItAndReplacedElsewhere) {
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  const int reader = ::open(path.c_str(), O_RDONLY | O_NONBLOCK);
  ASSERT_GE(reader, 0);
  replace_file(path, "text");
  std::array<char, 8> read{};
  EXPECT_EQ(::read(reader, read.data(), read.size()), 4);
  ::close(reader);
  replace_file(path, "text");
  EXPECT_EQ(content(path), "text");
  EXPECT_TRUE(fs::is_regular_file(path));
}

TEST_F(AtomicFileTest, WhatDeadProcessesLeftIsRemovedAndNothingElse) {
  for (const char* name : {"file.part-0123456789abcdef", "file.part-1", "file.part", "other"})
    std::ofstream(folder / name) << "x";
  remove_unfinished_files(folder.string());
  EXPECT_EQ(files(), 3u);
  EXPECT_FALSE(fs::exists(folder / "file.part-0123456789abcdef"));
}

}  // namespace
}  // namespace enfilade
