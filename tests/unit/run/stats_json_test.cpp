#include "run/stats_json.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.hpp"

namespace enfilade {
namespace {

TEST(StatsJson, ReadsWhatItWrote) {
  RunRecord record;
  record.set("patches", 360000);
  record.set("residual", 1.25e-7);
  record.set("nothing", std::nan(""));
  record.set("converged", RunRecord::Value(true));
  record.set("basis", "linear \"quoted\"");
  record.set("idle_s", std::vector<double>{0.5, 1.0 / 3.0});
  const RunRecord back = record_from(to_json(record), "stats.json");
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
  EXPECT_THROW(record_from(R"({"a": {"b": 1}})", "nested"), InputError);
  EXPECT_THROW(record_from("[1, 2]", "list"), InputError);
  EXPECT_THROW(record_from(R"({"a": 1)", "cut"), InputError);
}

TEST(StatsJson, AllMayBeMissing) {
  const std::string none = testing::TempDir() + "no_such_run";
  EXPECT_TRUE(read_stats(none).entries().empty());
  EXPECT_TRUE(read_history(none).empty());
  EXPECT_TRUE(read_owners(none).empty());
  EXPECT_TRUE(read_warnings(none).empty());
}

TEST(StatsJson, ReadsTheHistory) {
  const auto history =
      history_from(R"([{"iteration": 1, "links": 10}, {"iteration": 2, "links": 30}])", "history");
  ASSERT_EQ(history.size(), 2u);
  EXPECT_EQ(history[1].number("links", 0.0), 30.0);
  EXPECT_THROW(history_from(R"({"iteration": 1})", "bad"), InputError);
}

TEST(StatsJson, ReadsOwnersAndLines) {
  EXPECT_EQ(owners_from("[0, 3, 1]", "owners"), (std::vector<Rank>{Rank{0}, Rank{3}, Rank{1}}));
  EXPECT_EQ(lines_from(R"(["one", "two"])", "lines"), (std::vector<std::string>{"one", "two"}));
  EXPECT_THROW(owners_from("[-1]", "owners"), InputError);
  EXPECT_THROW(owners_from("[1e30]", "owners"), InputError);
}

TEST(StatsJson, FindsTheScenesLicenceAtTheTopOnly) {
  const auto lines = read_attribution(
      R"({"source": "A house", "surfaces": [{"licence": "no"}], "licence": "CC BY 4.0", "units": "m"})");
  EXPECT_EQ(lines, (std::vector<std::string>{"source: A house", "licence: CC BY 4.0"}));
}

}  // namespace
}  // namespace enfilade
