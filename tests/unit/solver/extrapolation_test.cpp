#include "solver/extrapolation.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace enfilade {
namespace {

IterationSummary iteration(double change, double extrapolation) {
  IterationSummary s;
  s.corrected = true;
  s.plan.extrapolation = extrapolation;
  s.figures.change_power = change;
  s.figures.arriving_power = {100.0};
  s.figures.returning_power = {50.0};
  return s;
}

IterationPlan plan_that(bool refines) {
  IterationPlan plan;
  plan.refine = refines;
  return plan;
}
const IterationPlan resting = plan_that(false);

TEST(Extrapolation, WaitsForLinksToRestAndForTheCoarseCorrection) {
  std::vector<IterationSummary> history{iteration(1.0, 0.0)};
  EXPECT_EQ(extrapolation_of(plan_that(true), history), 0.0);
  EXPECT_EQ(extrapolation_of(resting, history), 1.0);  // keeps the light
  history.push_back(iteration(0.5, 1.0));
  EXPECT_GT(extrapolation_of(resting, history), 1.0);
  history.back().corrected = false;
  EXPECT_EQ(extrapolation_of(resting, history), 0.0);
}

TEST(Extrapolation, FindsTheContractionThatTheChangesShow) {
  // An error that an iteration multiplies by 0.8, without and with extrapolation by 1.1: the larger
  // root of z^2 - 1.1 * 0.8 z + 0.1 = 0.
  const double root = 0.44 + std::sqrt(0.44 * 0.44 - 0.1), best = 2.0 / (1.0 + 0.6);
  const std::vector<IterationSummary> plain{iteration(1.0, 1.0), iteration(0.8, 1.0),
                                            iteration(0.64, 1.0)};
  EXPECT_NEAR(extrapolation_of(resting, plain), best, 1e-9);
  const std::vector<IterationSummary> extrapolated{iteration(1.0, 1.1), iteration(root, 1.1),
                                                   iteration(root * root, 1.1)};
  EXPECT_NEAR(extrapolation_of(resting, extrapolated), best, 1e-9);
  // Another flux correction moves the light as well.
  std::vector<IterationSummary> moved = plain;
  moved.back().plan.flux_correction = {0.1};
  EXPECT_LT(extrapolation_of(resting, moved), 1.1);
}

/// The extrapolation after `count` resting iterations that each change the light by `ratio` times
/// as much as the one before.
std::vector<IterationSummary> resting_iterations(int count, double ratio) {
  std::vector<IterationSummary> history{iteration(1.0, 0.0)};
  for (int i = 0; i < count; ++i) {
    history.push_back(iteration(std::pow(ratio, i), extrapolation_of(resting, history)));
    history.back().plan.refine = false;
  }
  return history;
}

TEST(Extrapolation, EndsWhereTheLightNeverRests) {
  const double slow = extrapolation_of(resting, resting_iterations(40, 0.99));
  EXPECT_NEAR(slow, 2.0 / (1.0 + std::sqrt(1.0 - 0.81)), 1e-9) << "light that comes to rest slowly";
  std::vector<IterationSummary> restless = resting_iterations(13, 1.0);
  EXPECT_GT(restless[12].plan.extrapolation, 1.3);
  EXPECT_EQ(restless[13].plan.extrapolation, 0.0);
  for (int i = 0; i < 6; ++i) {
    restless.push_back(iteration(std::pow(0.8, i), extrapolation_of(resting, restless)));
    restless.back().plan.refine = false;
    EXPECT_EQ(restless.back().plan.extrapolation, 0.0) << "and does not begin anew";
  }
  // Finer links are another system.
  restless.push_back(iteration(1.0, 0.0));
  EXPECT_EQ(extrapolation_of(resting, restless), 1.0);
}

TEST(Extrapolation, GoesOnWhereSomethingElseMovedTheLight) {
  // A flux correction that changes late moves the light as the first iterations did.
  std::vector<IterationSummary> history = resting_iterations(11, 0.8);
  history.push_back(iteration(1.0, extrapolation_of(resting, history)));
  history.back().plan.refine = false;
  history.back().plan.flux_correction = {0.1};
  EXPECT_GT(extrapolation_of(resting, history), 1.0);
  // Nor does a coarse correction that failed once end it for good.
  history = resting_iterations(5, 0.8);
  history.back().corrected = false;
  for (const double expected : {0.0, 1.0}) {
    history.push_back(iteration(0.3, extrapolation_of(resting, history)));
    history.back().plan.refine = false;
    EXPECT_EQ(history.back().plan.extrapolation, expected);
  }
}

}  // namespace
}  // namespace enfilade
