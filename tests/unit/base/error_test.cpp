#include "base/error.hpp"

#include <gtest/gtest.h>

namespace enfilade {
namespace {

TEST(InputError, NamesFilePlaceFaultAndRemedyOnOneLine) {
  const InputError error("a.json", "surfaces[3]", "has no area", "give it three corners");
  EXPECT_STREQ(error.what(), "a.json: surfaces[3]: has no area; give it three corners");
}

TEST(Check, ThrowsWithItsOperands) {
  try {
    ENFILADE_CHECK(1 > 2, "1, 2");
    FAIL();
  } catch (const std::logic_error& e) {
    EXPECT_NE(std::string(e.what()).find("1 > 2 (1, 2)"), std::string::npos);
  }
}

}  // namespace
}  // namespace enfilade
