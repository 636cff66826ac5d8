#include "base/warnings.hpp"

#include <gtest/gtest.h>

namespace enfilade {
namespace {

TEST(Warnings, EqualOnesBecomeOneLine) {
  Warnings w;
  for (int i = 0; i < 5; ++i) w.add("surface " + std::to_string(i), "dropped");
  w.add("lamp", "clamped");
  const auto lines = w.summary(2);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0], "surface 0, surface 1 and 3 more: dropped");
  EXPECT_EQ(lines[1], "lamp: clamped");
}

}  // namespace
}  // namespace enfilade
