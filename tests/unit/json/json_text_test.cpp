#include "json/json_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.hpp"

namespace enfilade {
namespace {

std::string fault_of(const std::string& text) {
  try {
    parse_json(text, "file");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string nested(std::size_t depth) { return std::string(depth, '[') + std::string(depth, ']'); }

TEST(JsonText, WhatLiesTooDeepIsRefusedWithItsPlace) {
  EXPECT_EQ(fault_of(nested(100)), "");
  EXPECT_THAT(fault_of("\n" + nested(101)), testing::StartsWith("file: line 2:101: "));
  EXPECT_THAT(fault_of(nested(1000000)), testing::HasSubstr("more than 100 deep"));
  EXPECT_THAT(fault_of(std::string(100000, '[')), testing::HasSubstr("more than 100 deep"));
  std::string objects;
  for (int i = 0; i < 200; ++i) objects += "{\"a\":";
  EXPECT_THAT(fault_of(objects), testing::HasSubstr("more than 100 deep"));
}

TEST(JsonText, BracketsInTextAreNotDeep) {
  EXPECT_EQ(fault_of("[\"" + std::string(1000, '[') + "\\\"" + std::string(1000, '{') + "\"]"), "");
}

TEST(JsonText, NoWordOfTheLibraryReachesTheUser) {
  for (const char* text :
       {"{", "[1e999", "{\"a\" 1}", "nul", "\x80", "[1,]", "[NaN,1e3081-0]", "\"\\uD800\""})
    EXPECT_THAT(fault_of(text), testing::AllOf(testing::StartsWith("file: line 1:"),
                                               testing::Not(testing::HasSubstr("json.exception"))))
        << text;
}

}  // namespace
}  // namespace enfilade
