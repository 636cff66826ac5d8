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
           [](const nlohmann::ordered_json& json) { [[maybe_unused]] const int x = json.at("x"); });
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
