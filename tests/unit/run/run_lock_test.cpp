#include "run/run_lock.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>

#include "base/error.hpp"

namespace enfilade {
namespace {

struct RunLockTest : testing::Test {
  std::string run = testing::TempDir() + "enfilade-run-lock";
  RunLockTest() {
    std::filesystem::remove_all(run);
    std::filesystem::create_directories(run);
  }
  ~RunLockTest() override { std::filesystem::remove_all(run); }
};

TEST_F(RunLockTest, OneWritesOrManyRead) {
  RunLock reader, another_reader, writer, other;
  EXPECT_NO_THROW(reader.read(run)) << "nobody has written there yet";
  writer.write(run);
  EXPECT_NO_THROW(writer.write(run)) << "has it already";
  EXPECT_THROW(other.write(run), InputError);
  EXPECT_THROW(another_reader.read(run), InputError);
}

TEST_F(RunLockTest, ARefusalNamesTheHolder) {
  RunLock writer, other;
  writer.write(run);
  try {
    other.write(run);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("process " + std::to_string(::getpid())));
  }
}

TEST_F(RunLockTest, ReadersDoNotDisturbEachOther) {
  { RunLock().write(run); }
  RunLock one, two;
  one.read(run);
  EXPECT_NO_THROW(two.read(run));
}

TEST_F(RunLockTest, EndsWithItsProcessHoweverThatDies) {
  int told[2];
  ASSERT_EQ(::pipe(told), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    RunLock writer;
    writer.write(run);
    writer.join(run);
    [[maybe_unused]] const auto n = ::write(told[1], "x", 1);
    ::pause();
  }
  char x = 0;
  ASSERT_EQ(::read(told[0], &x, 1), 1);
  EXPECT_THROW(RunLock().write(run), InputError);
  ::kill(child, SIGSTOP);
  EXPECT_THROW(RunLock().write(run), InputError) << "stopped, it lives";
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  EXPECT_NO_THROW(RunLock().write(run));
  ::close(told[0]);
  ::close(told[1]);
}

TEST_F(RunLockTest, WhatDeadCommandsLeftIsRemoved) {
  const std::string left = run + "/common/manifest.json.part-0123456789abcdef";
  std::filesystem::create_directories(run + "/common");
  std::filesystem::copy_file("/proc/self/status", left);
  RunLock().write(run);
  EXPECT_FALSE(std::filesystem::exists(left));
}

TEST_F(RunLockTest, NoLinkIsFollowed) {
  std::filesystem::create_symlink("/dev/null", run + "/lock");
  EXPECT_THROW(RunLock().write(run), RunError);
}

}  // namespace
}  // namespace enfilade
