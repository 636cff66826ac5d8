#include "run/stats_json.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "base/error.hpp"

namespace enfilade {
namespace {

std::string file_with(const std::string& name, const std::string& text) {
  const std::string path = testing::TempDir() + name;
  std::ofstream(path) << text;
  return path;
}

TEST(StatsJson, ReadsWhatItWrote) {
  RunRecord record;
  record.set("patches", 360000);
  record.set("residual", 1.25e-7);
  record.set("nothing", std::nan(""));
  record.set("converged", RunRecord::Value(true));
  record.set("basis", "linear \"quoted\"");
  record.set("idle_s", std::vector<double>{0.5, 1.0 / 3.0});
  const std::string path = testing::TempDir() + "stats.json";
  write_stats(record, path);
  const RunRecord back = read_stats(path);
  ASSERT_EQ(back.entries().size(), record.entries().size());
  for (std::size_t i = 0; i < record.entries().size(); ++i) {
    EXPECT_EQ(back.entries()[i].first, record.entries()[i].first) << "keys keep their order";
  }
  EXPECT_EQ(*back.find("patches"), RunRecord::Value(std::int64_t{360000}));
  EXPECT_EQ(*back.find("residual"), RunRecord::Value(1.25e-7));
  EXPECT_TRUE(std::isnan(back.number("nothing", 0.0)));
  EXPECT_EQ(*back.find("converged"), RunRecord::Value(true));
  EXPECT_EQ(*back.find("basis"), RunRecord::Value(std::string("linear \"quoted\"")));
  EXPECT_EQ(*back.find("idle_s"), RunRecord::Value(std::vector<double>{0.5, 1.0 / 3.0}));
}

TEST(StatsJson, WritesNanAsNull) {
  RunRecord record;
  record.set("residual", INFINITY);
  EXPECT_THAT(to_json(record), testing::HasSubstr("\"residual\": null"));
}

TEST(StatsJson, RefusesWhatIsNotFlat) {
  EXPECT_THROW(read_stats(file_with("nested.json", R"({"a": {"b": 1}})")), InputError);
  EXPECT_THROW(read_stats(file_with("list.json", "[1, 2]")), InputError);
  EXPECT_THROW(read_stats(file_with("cut.json", R"({"a": 1)")), InputError);
  EXPECT_THROW(read_stats(testing::TempDir() + "no_such_file.json"), InputError);
}

TEST(StatsJson, HistoryOwnersAndWarningsMayBeMissing) {
  const std::string none = testing::TempDir() + "no_such_file.json";
  EXPECT_TRUE(read_history(none).empty());
  EXPECT_TRUE(read_owners(none).empty());
  EXPECT_TRUE(read_lines(none).empty());
  EXPECT_TRUE(read_attribution(none).empty());
}

TEST(StatsJson, ReadsTheHistory) {
  const auto history = read_history(file_with(
      "history.json", R"([{"iteration": 1, "links": 10}, {"iteration": 2, "links": 30}])"));
  ASSERT_EQ(history.size(), 2u);
  EXPECT_EQ(history[1].number("links", 0.0), 30.0);
  EXPECT_THROW(read_history(file_with("bad.json", R"({"iteration": 1})")), InputError);
}

TEST(StatsJson, ReadsOwnersAndLines) {
  EXPECT_EQ(read_owners(file_with("owners.json", "[0, 3, 1]")),
            (std::vector<Rank>{Rank{0}, Rank{3}, Rank{1}}));
  EXPECT_EQ(read_lines(file_with("lines.json", R"(["one", "two"])")),
            (std::vector<std::string>{"one", "two"}));
  EXPECT_THROW(read_owners(file_with("owners.json", "[-1]")), InputError);
}

TEST(StatsJson, FindsTheScenesLicenceAtTheTopOnly) {
  const auto lines = read_attribution(file_with(
      "scene.json",
      R"({"source": "A house", "surfaces": [{"licence": "no"}], "licence": "CC BY 4.0", "units": "m"})"));
  EXPECT_EQ(lines, (std::vector<std::string>{"source: A house", "licence: CC BY 4.0"}));
}

}  // namespace
}  // namespace enfilade
