#include "machine/cost_model.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "base/error.hpp"
#include "unit/source_files.hpp"

namespace enfilade {
namespace {

std::string text_of_shipped() {
  std::ifstream in(source_file("platforms/cost_model.json"));
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

/// The shipped model with one piece of text replaced.
std::string altered(const std::string& what, const std::string& by) {
  std::string text = text_of_shipped();
  const auto at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  text.replace(at, what.size(), by);
  return text;
}

std::string message_for(const std::string& text) {
  try {
    cost_model_from(text, "costs.json");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(CostModel, DefaultsAreThoseOfTheShippedFile) {
  const CostModel file = cost_model_from(text_of_shipped(), "costs.json"), built;
  WorkCount one_of_each{1, 1, 1, 1, 1, 1, 1, 1};
  EXPECT_DOUBLE_EQ(price_flops(file, one_of_each), price_flops(built, one_of_each));
  EXPECT_DOUBLE_EQ(file.flops.ray, built.flops.ray);
  EXPECT_DOUBLE_EQ(file.disk.seek_s, built.disk.seek_s);
  EXPECT_DOUBLE_EQ(file.disk.request_s, built.disk.request_s);
  EXPECT_EQ(file.disk.request_bytes, built.disk.request_bytes);
  EXPECT_EQ(file.records.link_bytes, built.records.link_bytes);
}

TEST(CostModel, PricesEachKindOfWorkByItsOwnCost) {
  const CostModel m = cost_model_from(altered("\"ray\": 3000", "\"ray\": 1000"), "costs.json");
  WorkCount work;
  work.rays = 7;
  EXPECT_DOUBLE_EQ(price_flops(m, work), 7000.0);
  work.push_pulls = 2;
  EXPECT_DOUBLE_EQ(price_flops(m, work), 7000.0 + 2 * m.flops.push_pull);
}

TEST(CostModel, RecordsCountAtTheirOwnSizeUnlessTheModelHasAnother) {
  const RecordCount count{10, 20, 30, 12345};
  EXPECT_EQ(price_record(CostModel{}, count), 12345u);
  const CostModel m =
      cost_model_from(altered("\"link_bytes\": 0", "\"link_bytes\": 800"), "costs.json");
  EXPECT_EQ(price_record(m, count), 30u * 800u);
}

TEST(CostModel, NamesWhatIsWrongWithAFile) {
  EXPECT_NE(message_for(altered("\"ray\": 3000", "\"ray\": -1")).find("flops.ray"),
            std::string::npos);
  EXPECT_NE(message_for(altered("\"ray\"", "\"rays\"")).find("flops.rays"), std::string::npos);
  EXPECT_NE(message_for(altered("    \"seek_s\": 0.012,\n", "")).find("disk.seek_s: missing"),
            std::string::npos);
  EXPECT_NE(message_for(altered("enfilade-cost-model", "x")).find("format"), std::string::npos);
  EXPECT_NE(message_for(altered("{", "")).find("not valid JSON"), std::string::npos);
}

TEST(ParseBytes, TakesSuffixesAndRefusesTheRest) {
  EXPECT_EQ(parse_bytes("123", "f", "w"), 123u);
  EXPECT_EQ(parse_bytes("2K", "f", "w"), 2048u);
  EXPECT_EQ(parse_bytes("1.5M", "f", "w"), 1572864u);
  EXPECT_EQ(parse_bytes("4GiB", "f", "w"), std::uint64_t{4} << 30);
  for (const char* bad : {"", "M", "-1", "12Q", "1e30G", "nan"}) {
    EXPECT_THROW(parse_bytes(bad, "f", "w"), InputError) << bad;
  }
}

TEST(CostModel, AFormatOfAnotherKindAndNumbersBeyondAllBoundsAreRefusedByName) {
  EXPECT_NE(message_for(altered("\"enfilade-cost-model\"", "3")).find("format: "),
            std::string::npos);
  EXPECT_NE(message_for(altered("\"version\": 1", "\"version\": []")).find("format: "),
            std::string::npos);
  EXPECT_NE(message_for(altered("\"ray\": 3000", "\"ray\": 1e999"))
                .find("flops.ray: not a number from 0 to 1e18"),
            std::string::npos);
  EXPECT_NE(message_for(altered("\"ray\": 3000", "\"ray\": 1e30")).find("flops.ray"),
            std::string::npos);
}

}  // namespace
}  // namespace enfilade
