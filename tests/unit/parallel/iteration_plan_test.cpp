#include "parallel/iteration_plan.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"

namespace enfilade {
namespace {

IterationSummary summary(int iteration, double change, double links_refined = 0.0) {
  IterationSummary s;
  s.plan.iteration = iteration;
  s.plan.close_rows = true;
  s.sums.change_power = change;
  s.sums.received_power = 100.0;
  s.sums.links = 10000;
  s.sums.work.links_refined = static_cast<std::uint64_t>(links_refined);
  return s;
}

const PlanConfig config{
    .emitted_power = 10.0, .epsilon = 1e-3, .tolerance = 1e-4, .max_iterations = 50};

TEST(IterationPlan, LinkToleranceIsAShareOfTheEmittedPower) {
  EXPECT_DOUBLE_EQ(first_plan(config).link_tolerance, 0.01);
  EXPECT_EQ(first_plan(config).iteration, 1);
  EXPECT_FALSE(first_plan(config).finished);
}

TEST(IterationPlan, EndsWhenTheLightIsStillAndNothingWasRefined) {
  const std::vector<IterationSummary> still = {summary(1, 50.0, 9000), summary(2, 0.005)};
  const IterationPlan plan = next_plan(still, config);
  EXPECT_TRUE(plan.finished);
  EXPECT_TRUE(plan.converged);
  EXPECT_EQ(plan.iteration, 3);

  const std::vector<IterationSummary> refining = {summary(1, 50.0, 9000), summary(2, 0.005, 5000)};
  EXPECT_FALSE(next_plan(refining, config).finished);
  const std::vector<IterationSummary> moving = {summary(1, 50.0, 9000), summary(2, 1.0)};
  EXPECT_FALSE(next_plan(moving, config).finished);
}

TEST(IterationPlan, GivesUpAtTheLimitAndSaysSo) {
  const std::vector<IterationSummary> history = {summary(49, 60.0), summary(50, 50.0)};
  const IterationPlan plan = next_plan(history, config);
  EXPECT_TRUE(plan.finished);
  EXPECT_FALSE(plan.converged);
}

TEST(IterationPlan, EstimateCountsTheChangesThatAreStillToCome) {
  // At contraction 0.95 the changes still to come are 19 times the last one.
  const std::vector<IterationSummary> history = {summary(1, 10.0), summary(2, 9.5)};
  EXPECT_DOUBLE_EQ(contraction(history), 0.95);
  EXPECT_NEAR(estimate_error(history), 9.5 * 19.0 / 100.0, 1e-9);
}

TEST(IterationPlan, RefinesUntilTheAskedErrorIsEstimated) {
  const PlanConfig asked{.emitted_power = 10.0, .target_error = 0.02, .max_iterations = 50};
  std::vector<IterationSummary> history = {summary(1, 50.0, 9000), summary(2, 0.005)};
  for (IterationSummary& s : history) s.plan.link_tolerance = 1e-3;
  history.back().sums.link_error_power = 50.0;  // half of all that is received: far above 2%
  const IterationPlan finer = next_plan(history, asked);
  EXPECT_FALSE(finer.finished);
  EXPECT_LT(finer.link_tolerance, 0.7 * 1e-3 + 1e-12);
  EXPECT_TRUE(finer.refine);

  history.back().sums.link_error_power = 1.0;
  EXPECT_TRUE(next_plan(history, asked).converged);

  // Finer tolerances that find nothing left to refine: it ends, and says that it did not get there.
  history.back().sums.link_error_power = 50.0;
  history.back().plan.link_tolerance = 0.5e-3;
  history.back().plan.refine = true;
  const IterationPlan stuck = next_plan(history, asked);
  EXPECT_TRUE(stuck.finished);
  EXPECT_FALSE(stuck.converged);
}

TEST(IterationPlan, NumbersComeBackAsTheyWere) {
  IterationSummary s = summary(7, 3.25, 12);
  s.plan.link_tolerance = 0.125;
  s.plan.refine = false;
  s.estimated_error = 0.5;
  s.time_s = 9.0;
  s.sums.max_change = 0.75;
  s.sums.steals = 3;
  s.sums.work.rays = 1234567890123;
  s.sums.work.shafts = 8;
  s.sums.absorbed_power = {1.0, 2.0, 3.0};
  s.sums.escaping_power = {4.0, 5.0, 6.0};
  const IterationSummary back = summary_from(to_numbers(s));
  EXPECT_EQ(to_numbers(back), to_numbers(s));
  EXPECT_EQ(back.plan.iteration, 7);
  EXPECT_FALSE(back.plan.refine);
  EXPECT_EQ(back.sums.work.rays, 1234567890123u);
  EXPECT_EQ(back.sums.work.shafts, 8u);
  EXPECT_EQ(back.sums.absorbed_power, s.sums.absorbed_power);
  EXPECT_EQ(back.sums.escaping_power, s.sums.escaping_power);
  EXPECT_THROW(summary_from(std::vector<double>(9, 1.0)), RunError);
}

}  // namespace
}  // namespace enfilade
