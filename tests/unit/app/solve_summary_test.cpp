#include "app/solve_summary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace enfilade {
namespace {

TEST(SolveSummary, ValuesAreShownByTheirUnit) {
  using Value = RunRecord::Value;
  EXPECT_EQ(shown_value("links", Value(std::int64_t{1234567})), "1,234,567");
  EXPECT_EQ(shown_value("peak_rss_bytes", Value(std::int64_t{3 << 20})), "3.0 MiB");
  EXPECT_EQ(shown_value("solve_s", Value(90.0)), "1 min 30 s");
  EXPECT_EQ(shown_value("estimated_error", Value(0.0173)), "1.7%");
  EXPECT_EQ(shown_value("io_s", Value(std::vector<double>{1.0, 2.5})), "1.00 s, 2.50 s");
  EXPECT_EQ(shown_value("converged", Value(true)), "yes");
}

TEST(SolveSummary, SaysWhetherTheAskedErrorWasReached) {
  RunRecord record;
  record.set("converged", RunRecord::Value(true));
  record.set("target_error", 0.02);
  record.set("estimated_error", 0.01);
  EXPECT_THAT(solve_summary("run", record), testing::StartsWith("run: solved\n"));
  record.set("estimated_error", 0.03);
  EXPECT_THAT(solve_summary("run", record), testing::HasSubstr("above the asked error"));
  record.set("converged", RunRecord::Value(false));
  EXPECT_THAT(solve_summary("run", record), testing::HasSubstr("gave up"));
}

TEST(SolveSummary, AShortfallIsToldWithItsRemedy) {
  RunRecord record;
  record.set("iterations", 7);
  record.set("estimated_error", 0.31);
  record.set("target_error", 0.02);
  record.set("converged", RunRecord::Value(true));
  EXPECT_TRUE(shortfall_of("run", record, 7).empty());
  record.set("converged", RunRecord::Value(false));
  const auto told = [&](int most) { return shortfall_of("run", record, most).summary().at(0); };
  EXPECT_THAT(told(7), testing::AllOf(testing::HasSubstr("7 iterations: estimated error 31%"),
                                      testing::HasSubstr("--max-iterations")));
  EXPECT_THAT(told(8), testing::HasSubstr("--target-error"));
}

TEST(SolveSummary, NamesTheIterationsWithoutACoarseCorrection) {
  std::vector<IterationSummary> history(4);
  for (std::size_t i = 0; i < history.size(); ++i) {
    history[i].plan.iteration = static_cast<int>(i) + 1;
  }
  EXPECT_TRUE(correction_failures("run", history).empty());
  history[1].correction_failed = history[3].correction_failed = true;
  EXPECT_THAT(correction_failures("run", history).summary().at(0),
              testing::HasSubstr("after iteration 2, 4, and was left out"));
}

TEST(SolveProgress, RunsFromTheFirstErrorToTheAskedOne) {
  std::vector<double> fractions;
  SolveProgress progress(0.01, [&](std::string_view, double f) { fractions.push_back(f); });
  const auto observer = progress.observer();
  for (const double error : {1.0, 0.1, 0.005}) {
    IterationSummary summary;
    summary.error.discretisation = error;
    observer(summary);
  }
  ASSERT_EQ(fractions.size(), 3u);
  EXPECT_DOUBLE_EQ(fractions[0], 0.0);
  EXPECT_NEAR(fractions[1], 0.5, 1e-12);
  EXPECT_DOUBLE_EQ(fractions[2], 1.0);
}

}  // namespace
}  // namespace enfilade
