#include "import/intake/own_process.hpp"

#include <unistd.h>

#include <csignal>

#include "unit/scene/test_scenes.hpp"

namespace enfilade {
namespace {

using ::testing::HasSubstr;
using Bytes = std::vector<std::byte>;

std::string error_of(const std::function<Bytes()>& work, const ProcessLimits& limits = {}) {
  return input_error([&] { in_own_process("m.x", limits, work); });
}

TEST(OwnProcess, ReturnsWhatTheWorkReturns) {
  const Bytes large(std::size_t{1} << 20, std::byte{7});
  int here = 0;
  EXPECT_EQ(in_own_process("m.x", {}, [&] { return ++here, large; }), large);
  EXPECT_EQ(here, 0);  // it was not this process that counted
  EXPECT_TRUE(in_own_process("m.x", {}, [] { return Bytes(); }).empty());
}

TEST(OwnProcess, WhateverHappensIsOneLine) {
  EXPECT_EQ(
      error_of([]() -> Bytes { throw InputError("a.x", "line 2", "is bad; very", "mend it"); }),
      "a.x: line 2: is bad; very; mend it");
  for (const int signal : {SIGSEGV, SIGABRT, SIGKILL, SIGFPE}) {
    EXPECT_THAT(error_of([=]() -> Bytes {
                  std::signal(signal, SIG_DFL);
                  ::raise(signal);
                  return {};
                }),
                HasSubstr("m.x: file: crashed its reader ("))
        << signal;
  }
  EXPECT_THAT(error_of([]() -> Bytes { ::_exit(0); }), HasSubstr("without an answer"));
  EXPECT_THAT(error_of([]() -> Bytes { throw std::bad_alloc(); }), HasSubstr("MiB of memory"));
  EXPECT_THROW(in_own_process("m.x", {}, []() -> Bytes { throw RunError("disk"); }), RunError);
}

TEST(OwnProcess, MemoryEnds) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer's shadow memory knows no limit";
#endif
  EXPECT_THAT(error_of([] { return Bytes(std::size_t{1} << 30); }, {std::uint64_t{1} << 26, 60.0}),
              HasSubstr("needs more than 64 MiB of memory"));
}

TEST(OwnProcess, TimeEnds) {
  EXPECT_THAT(
      error_of([]() -> Bytes { return ::sleep(60), Bytes(); }, {std::uint64_t{1} << 30, 0.3}),
      HasSubstr("takes more than"));
}

TEST(OwnProcess, RunsProgramsWithInput) {
  const std::string text(std::size_t{300'000}, 'x');
  const ProgramResult cat = run_program({"cat"}, text, {});
  EXPECT_EQ(cat.output, text);
  EXPECT_EQ(cat.exit_status, 0);
  const ProgramResult ends_early = run_program({"true"}, text, {});
  EXPECT_EQ(ends_early.exit_status, 0);
  EXPECT_EQ(run_program({"enfilade-no-such-program"}, "", {}).exit_status, 127);
  EXPECT_EQ(run_program({"sh", "-c", "kill -SEGV $$"}, "", {}).signal, SIGSEGV);
  EXPECT_TRUE(run_program({"sleep", "60"}, "", {std::uint64_t{1} << 30, 0.3}).timed_out);
}

TEST(OwnProcess, KeepsTheEndOfWhatAProgramComplains) {
  constexpr std::size_t most = ProgramResult::most_errors;
  const ProgramResult complains = run_program(
      {"sh", "-c", "head -c 20000000 /dev/zero | tr '\\0' e >&2; printf end >&2; printf out"}, "",
      {});
  EXPECT_EQ(complains.errors, std::string(most - 3, 'e') + "end");
  EXPECT_EQ(complains.output, "out");
  EXPECT_LE(complains.errors.capacity(), 4 * most);  // at no time was more kept
  EXPECT_EQ(run_program({"sh", "-c", "printf short >&2"}, "", {}).errors, "short");
}

}  // namespace
}  // namespace enfilade
