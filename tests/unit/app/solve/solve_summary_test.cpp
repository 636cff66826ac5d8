#include "app/solve/solve_summary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace enfilade {
namespace {

TEST(SolveSummary, SaysWhetherTheTargetErrorWasReached) {
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

TEST(SolveSummary, AShortfallComesWithItsRemedy) {
  RunRecord record;
  record.set("iterations", 7);
  record.set("estimated_error", 0.31);
  record.set("target_error", 0.02);
  record.set("converged", RunRecord::Value(true));
  EXPECT_TRUE(shortfall_of("run", record, 7).empty());
  record.set("converged", RunRecord::Value(false));
  const auto warning = [&](int most) { return shortfall_of("run", record, most).summary().at(0); };
  EXPECT_THAT(warning(7), testing::AllOf(testing::HasSubstr("7 iterations: estimated error 31%"),
                                         testing::HasSubstr("--max-iterations")));
  EXPECT_THAT(warning(8), testing::HasSubstr("--target-error"));
}

TEST(SolveSummary, CountsTheIterationsWithoutACoarseCorrection) {
  std::vector<IterationSummary> history(4);
  EXPECT_TRUE(correction_failures("run", history).empty());
  history[1].correction_failed = history[3].correction_failed = true;
  EXPECT_THAT(correction_failures("run", history).summary().at(0),
              testing::HasSubstr("after 2 of 4 iterations, and was left out"));
}

TEST(SolveProgress, RunsFromTheFirstErrorToTheTarget) {
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
