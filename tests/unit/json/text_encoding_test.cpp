#include "json/text_encoding.hpp"

#include <gtest/gtest.h>

namespace enfilade {
namespace {

using namespace std::string_literals;

TEST(TextEncoding, Utf16IsReadByItsMark) {
  EXPECT_EQ(file_in_utf8("\xFF\xFE"s + "a\0\xE4\0"s), "a\xC3\xA4");
  EXPECT_EQ(file_in_utf8("\xFE\xFF"s + "\0a\x20\xAC"s), "a\xE2\x82\xAC");
  EXPECT_EQ(file_in_utf8("\xFF\xFE"s + "\x3D\xD8\x00\xDE"s), "\xF0\x9F\x98\x80");
}

TEST(TextEncoding, OtherTextStaysAsItIs) {
  EXPECT_EQ(file_in_utf8("\xEF\xBB\xBFx"), "\xEF\xBB\xBFx");
  EXPECT_EQ(file_in_utf8(""), "");
}

TEST(TextEncoding, WhatIsNoCharacterIsLeftOut) {
  EXPECT_EQ(file_in_utf8("\xFF\xFE"s + "a\0\x00\xDC"s + "b\0c"s), "ab");  // half a pair, half a c
}

TEST(TextEncoding, TextsLongerThanOneChunkAreWhole) {
  std::string bytes = "\xFE\xFF", text;
  for (int i = 0; i < 5000; ++i) {
    bytes += "\x20\xAC"s;
    text += "\xE2\x82\xAC";
  }
  EXPECT_EQ(file_in_utf8(bytes), text);
}

TEST(TextEncoding, Latin1) { EXPECT_EQ(in_utf8("\xE4", "ISO-8859-1"), "\xC3\xA4"); }

}  // namespace
}  // namespace enfilade
