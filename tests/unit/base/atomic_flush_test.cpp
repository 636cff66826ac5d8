// What is committed has been flushed before its name points to it: this test's own fsync() looks.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/atomic_file.hpp"

namespace {

struct Flushes {
  int count = 0;
  off_t bytes = -1;       ///< of the file that was flushed last
  bool replaced = false;  ///< the file at `path` was no longer the old one
  std::string path;
} flushes;

std::string content(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

}  // namespace

// The program's call comes here, since this definition is found before the C library's.
extern "C" int fsync(int fd) {
  struct stat info {};
  ++flushes.count;
  if (::fstat(fd, &info) == 0) flushes.bytes = info.st_size;
  if (!flushes.path.empty()) flushes.replaced |= content(flushes.path) != "old";
  return static_cast<int>(::syscall(SYS_fsync, fd));
}

namespace enfilade {
namespace {

TEST(AtomicFile, IsFlushedBeforeItsNamePointsToIt) {
  const std::string path =
      (std::filesystem::temp_directory_path() / ("flushed." + std::to_string(::getpid()))).string();
  std::ofstream(path) << "old";
  flushes = {};
  flushes.path = path;
  write_file_atomically(path, "the new content");
  EXPECT_EQ(flushes.count, 1);
  EXPECT_EQ(flushes.bytes, 15);
  EXPECT_FALSE(flushes.replaced) << "the name pointed to what was not on the disk";
  EXPECT_EQ(content(path), "the new content");
  std::filesystem::remove(path);
}

/// Until the commit the old file stays, whatever has been written of the new one.
TEST(AtomicFile, LeavesTheOldFileUntilItIsCommitted) {
  const std::string path =
      (std::filesystem::temp_directory_path() / ("kept." + std::to_string(::getpid()))).string();
  std::ofstream(path) << "old";
  {
    AtomicFile file(path);
    file.add("half of it");
    EXPECT_EQ(content(path), "old");
  }
  EXPECT_EQ(content(path), "old");
  {
    AtomicFile file(path);
    file.add("all");
    file.commit(false);
  }
  EXPECT_EQ(content(path), "all");
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace enfilade
