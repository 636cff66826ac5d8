#include "app/frame/console.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace enfilade {
namespace {

std::string said_by(bool speaks, const std::function<void(const Console&)>& what) {
  testing::internal::CaptureStderr();
  what(Console(speaks));
  return testing::internal::GetCapturedStderr();
}

TEST(Console, AnErrorIsOneLineWhateverItsText) {
  EXPECT_EQ(said_by(true, [](const Console& c) { c.error("file: line\n  two\t; do\r\nthis\n"); }),
            "enfilade: error: file: line   two ; do this\n");
}

TEST(Console, ASilentRankSaysNothing) {
  EXPECT_EQ(said_by(false, [](const Console& c) { c.error("x"); }), "");
}

TEST(Console, EqualWarningsShareALine) {
  Warnings warnings;
  for (int i = 0; i < 5; ++i) warnings.add("surfaces[" + std::to_string(i) + "]", "dropped");
  warnings.add("lights[0]", "dark");
  const std::string text = said_by(true, [&](const Console& c) { c.warnings(warnings); });
  EXPECT_EQ(std::ranges::count(text, '\n'), 2) << text;
  EXPECT_THAT(text, testing::StartsWith("enfilade: warning: surfaces[0]"));
  EXPECT_THAT(text, testing::HasSubstr("2 more"));
}

TEST(Console, NoProgressWhereStandardErrorIsNoTerminal) {
  testing::internal::CaptureStderr();
  const Console console(true);
  EXPECT_FALSE(console.progress());
  testing::internal::GetCapturedStderr();
}

}  // namespace
}  // namespace enfilade
