#include "base/run_on_threads.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <new>
#include <stdexcept>

#include "base/memory_wanted.hpp"

namespace enfilade {
namespace {

TEST(RunOnThreads, EachThreadWorksOnceAndOneIsFirst) {
  std::atomic<int> calls{0}, firsts{0};
  run_on_threads(4, [&](bool first) {
    ++calls;
    firsts += first ? 1 : 0;
  });
  EXPECT_EQ(calls, 4);
  EXPECT_EQ(firsts, 1);
}

TEST(RunOnThreads, AnErrorOfAnyThreadReachesTheCaller) {
  for (const bool of_first : {true, false}) {
    EXPECT_THROW(run_on_threads(3,
                                [&](bool first) {
                                  if (first == of_first) throw std::runtime_error("broken");
                                }),
                 std::runtime_error);
  }
}

TEST(RunOnThreads, MemoryThatAnyThreadIsRefusedIsToldToTheCaller) {
  for (const bool of_first : {true, false}) {
    // Another number each time, so that no refusal is taken for an earlier one.
    volatile std::size_t wanted = (std::size_t{1} << 60) + (of_first ? 1 : 2);
    const MemoryPurpose purpose("a test of threads");
    EXPECT_THROW(run_on_threads(3,
                                [&](bool first) {
                                  if (first == of_first) ::operator delete(::operator new(wanted));
                                }),
                 std::bad_alloc);
    EXPECT_EQ(refused_memory().bytes, wanted);
    EXPECT_STREQ(refused_memory().purpose.data(), "a test of threads");
  }
}

}  // namespace
}  // namespace enfilade
