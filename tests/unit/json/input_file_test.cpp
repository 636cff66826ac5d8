#include "json/input_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "base/error.hpp"

namespace enfilade {
namespace {

namespace fs = std::filesystem;

std::string fault(const std::string& path) {
  try {
    read_text(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

struct Fifo {
  std::string path = testing::TempDir() + "enfilade-fifo";
  Fifo() {
    fs::remove(path);
    EXPECT_EQ(::mkfifo(path.c_str(), 0600), 0);
  }
  ~Fifo() { fs::remove(path); }
};

TEST(InputFile, WhatIsNoFileIsToldAtOnce) {
  EXPECT_THAT(fault("/no/such/file"), testing::HasSubstr("does not exist"));
  EXPECT_THAT(fault(testing::TempDir()), testing::HasSubstr("is a directory"));
  EXPECT_THAT(fault("/dev/zero"), testing::HasSubstr("is a device"));
  EXPECT_THAT(fault("/dev/null"), testing::HasSubstr("is a device"));
}

TEST(InputFile, AFileOfMoreThanTheMachinesMemoryIsRefused) {
  const std::string path = testing::TempDir() + "enfilade-sparse";
  std::ofstream(path) << "x";
  fs::resize_file(path, std::uintmax_t{1} << 43);
  EXPECT_THAT(fault(path), testing::HasSubstr("this machine's memory"));
  fs::remove(path);
}

TEST(InputFile, APipeIsReadToItsEndHoweverSlowItsWriter) {
  const Fifo fifo;
  std::thread writer([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    std::ofstream out(fifo.path);
    for (int i = 0; i < 3; ++i) {
      out << "part" << i << std::flush;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  });
  EXPECT_EQ(read_text(fifo.path), "part0part1part2");
  writer.join();
}

TEST(InputFile, APipeThatNobodyWritesToIsNotWaitedForForever) {
  const Fifo fifo;
  EXPECT_THAT(fault(fifo.path), testing::HasSubstr("nobody writes to"));
}

}  // namespace
}  // namespace enfilade
