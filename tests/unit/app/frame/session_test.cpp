#include "app/frame/session.hpp"

#include <gmock/gmock.h>

#include <new>

#include "base/memory_wanted.hpp"
#include "base/run_on_threads.hpp"

namespace enfilade {
namespace {

using ::testing::StartsWith;

/// The line of error where this thread or another is refused memory.
std::string line_where_refused(bool in_worker) {
  volatile std::size_t wanted = std::size_t{3} << 40;
  const MemoryPurpose purpose("the test");
  try {
    run_on_threads(2, [&](bool first) {
      if (first != in_worker) ::operator delete(::operator new(wanted));
    });
  } catch (const std::exception& error) {
    return words_of(error);
  }
  return {};
}

TEST(Session, AWorkersLackOfMemoryIsToldAsTheMainThreads) {
  for (const bool in_worker : {true, false}) {
    EXPECT_THAT(line_where_refused(in_worker),
                StartsWith("memory: ran out: 3145728 MiB more wanted for the test, beside the "));
  }
}

}  // namespace
}  // namespace enfilade
