#include "store/posix_file.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <thread>

namespace enfilade {
namespace {

TEST(PosixFile, ADirectoryIsMadeWhileAnotherTakesItsParentAway) {
  namespace fs = std::filesystem;
  const fs::path home = fs::path(::testing::TempDir()) / "enfilade-posix-file";
  const fs::path parent = home / "local", own = parent / "rank-0";
  make_directory(home.string());
  std::atomic<bool> done = false;
  std::thread other([&] {
    for (std::error_code ignored; !done;) fs::remove(parent, ignored);
  });
  for (int i = 0; i < 300; ++i) {
    EXPECT_NO_THROW(make_directory(own.string()));
    fs::remove(own);
  }
  done = true;
  other.join();
  fs::remove_all(home);
}

}  // namespace
}  // namespace enfilade
