#include "json/sealed_json.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.hpp"

namespace enfilade {
namespace {

constexpr SealedFormat format{"enfilade-test", 3, "make it again"};

std::string seal_fault(const std::string& text) {
  try {
    unseal(format, text, "file",
           [](const nlohmann::ordered_json& json) { whole<std::int16_t>(json.at("x")); });
  } catch (const RunError& error) {
    return error.what();
  }
  return "";
}

TEST(SealedJson, ComesBackAndIsJson) {
  const std::string text = seal(format, {{"x", 7}, {"y", {0.1, 1e300, -0.0}}});
  EXPECT_EQ(seal_fault(text), "");
  EXPECT_EQ(nlohmann::json::parse(text)["version"], 3);
}

TEST(SealedJson, EveryBitThatTurnsIsFound) {
  const std::string text = seal(format, {{"x", 7}, {"y", {0.1, 1e300}}, {"z", "text"}});
  for (std::size_t at = 0; at + 1 < text.size(); ++at) {
    for (int bit = 0; bit < 8; ++bit) {
      std::string damaged = text;
      damaged[at] = static_cast<char>(damaged[at] ^ (1 << bit));
      EXPECT_NE(seal_fault(damaged), "") << damaged;
    }
  }
}

TEST(SealedJson, WholeNumbersFitOrAreRefused) {
  const std::string fault = "file: is damaged (a value is none); make it again";
  for (const char* fits : {"0", "-32768", "32767"})
    EXPECT_EQ(seal_fault(seal(format, {{"x", nlohmann::ordered_json::parse(fits)}})), "") << fits;
  for (const char* not_one :
       {"1e99", "1.5", "32768", "-32769", "18446744073709551615", "\"7\"", "true", "null"})
    EXPECT_EQ(seal_fault(seal(format, {{"x", nlohmann::ordered_json::parse(not_one)}})), fault)
        << not_one;
  EXPECT_THROW(whole<std::uint32_t>(nlohmann::json(-1)), std::out_of_range);
  EXPECT_THROW(whole_list<std::uint32_t>(nlohmann::json{1, -1}), std::out_of_range);
}

TEST(SealedJson, FaultsSayWhatToDo) {
  const std::string text = seal(format, {{"y", 1}});
  EXPECT_EQ(seal_fault(text),
            "file: is damaged (a value is missing, or of another kind); make it again");
  EXPECT_EQ(seal_fault(""), "file: is no JSON; make it again");
  EXPECT_EQ(seal_fault("[]"), "file: is not an enfilade-test; make it again");
  EXPECT_THAT(seal_fault(R"({"format": "enfilade-test", "version": 2})"),
              testing::HasSubstr("of another version of enfilade (2, this one knows 3)"));
}

}  // namespace
}  // namespace enfilade
