#include "base/posix_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "base/error.hpp"

namespace enfilade {
namespace {

TEST(PosixFile, AFullDiskIsReportedWithItsRemedy) {
  try {
    write_file("/dev/full", std::vector<std::byte>(10), {});
    FAIL();
  } catch (const RunError& error) {
    EXPECT_NE(std::string(error.what()).find("--resume"), std::string::npos) << error.what();
  }
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"))
      << "the device must outlive the test";
}

TEST(PosixFile, APipeInAFilesPlaceIsNotWaitedFor) {
  const std::string path = ::testing::TempDir() + "enfilade-pipe";
  std::filesystem::remove(path);
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  EXPECT_THROW(write_file(path, {}, {}), RunError);
  EXPECT_THROW(read_file(path), RunError);
  std::filesystem::remove(path);
}

TEST(PosixFile, ADirectoryIsMadeWhileAnotherTakesItsParentAway) {
  namespace fs = std::filesystem;
  const fs::path home = fs::path(::testing::TempDir()) / "enfilade-posix-file";
  const fs::path parent = home / "local", own = parent / "rank-0";
  make_directory(home.string());
  std::atomic<bool> done = false;
  std::thread other([&] {
    // The pause leaves the maker whole tries: of many ranks each takes the parent away only once.
    for (std::error_code ignored; !done;) {
      fs::remove(parent, ignored);
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
  });
  for (int i = 0; i < 3000; ++i) {
    EXPECT_NO_THROW(make_directory(own.string()));
    fs::remove(own);
  }
  done = true;
  other.join();
  fs::remove_all(home);
}

}  // namespace
}  // namespace enfilade
