#include "base/run_on_threads.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>

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

}  // namespace
}  // namespace enfilade
