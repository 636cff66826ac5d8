#include "base/nearest_word.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace enfilade {
namespace {

TEST(NearestWord, IsWithinTwoEditsOrBeginsSo) {
  const std::vector<std::string> known{"memory", "seek_s", "serves"};
  EXPECT_EQ(nearest_word("memry", known), "memory");
  EXPECT_EQ(nearest_word("server", known), "serves");
  EXPECT_EQ(nearest_word("mem", known), "memory");
  EXPECT_EQ(nearest_word("me", known), "");
  EXPECT_EQ(nearest_word("wattage", known), "");
}

}  // namespace
}  // namespace enfilade
