#include "base/memory_wanted.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <new>
#include <string>

namespace enfilade {
namespace {

TEST(MemoryWanted, TellsHowMuchWasRefusedAndForWhat) {
  constexpr std::size_t too_much = std::numeric_limits<std::size_t>::max() / 4;
  volatile std::size_t wanted = too_much;  // or the compiler would see it coming
  {
    const MemoryPurpose purpose("a test");
    EXPECT_THROW(::operator delete(::operator new(wanted)), std::bad_alloc);
  }
  EXPECT_EQ(refused_memory().bytes, too_much);
  EXPECT_EQ(std::string(refused_memory().purpose.data()), "a test");
}

}  // namespace
}  // namespace enfilade
