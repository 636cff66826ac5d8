#include "base/safe_text.hpp"

#include <gtest/gtest.h>

namespace enfilade {
namespace {

TEST(SafeText, NothingActsOnATerminal) {
  EXPECT_EQ(terminal_text("a\x1b[31mb\a"), "a\\x1b[31mb\\x07");
  EXPECT_EQ(terminal_text(std::string("nul\0", 4)), "nul\\x00");
  EXPECT_EQ(terminal_text("\xE2\x80\xAE"
                          "gnp.exe"),
            "\\u202egnp.exe")
      << "right-to-left override";
  EXPECT_EQ(terminal_text("\xC2\x9B"
                          "31m"),
            "\\x9b31m")
      << "one-character CSI";
  EXPECT_EQ(terminal_text("\rover"), "\\x0dover");
}

TEST(SafeText, WhatIsNoUtf8IsShownByItsBytes) {
  EXPECT_EQ(terminal_text("\xFF\xC0\x80"), "\\xff\\xc0\\x80");
  EXPECT_EQ(terminal_text("cut \xE2\x80"), "cut \\xe2\\x80");
  EXPECT_EQ(terminal_text("\xED\xA0\x80"), "\\xed\\xa0\\x80") << "half a surrogate pair";
}

TEST(SafeText, TextOfAnyScriptStays) {
  for (const char* text :
       {"Fußboden, 天井, стена \"запад\" 🛋", "two\nlines\tand a tab", ""})
    EXPECT_EQ(terminal_text(text), text);
}

TEST(SafeText, FilesGetTheReplacementCharacter) {
  EXPECT_EQ(file_text(std::string("a\0b\x1b", 4)),
            "a\xEF\xBF\xBD"
            "b\xEF\xBF\xBD");
}

}  // namespace
}  // namespace enfilade
