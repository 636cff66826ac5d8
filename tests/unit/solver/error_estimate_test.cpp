#include "solver/error_estimate.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace enfilade {
namespace {

/// Light 100 in one band, `reflected` of it by reflection.
IterationSummary summary(double change, double reflected = 50.0) {
  IterationSummary s;
  s.figures.change_power = change;
  s.figures.received_power = 100.0;
  s.figures.arriving_power = {100.0};
  s.figures.returning_power = {reflected};
  s.figures.absorbed_power = {50.0};
  s.figures.escaping_power = s.figures.direct_power = {0.0};
  return s;
}
const Spectrum emitted{50.0};

TEST(ErrorEstimate, CountsTheChangesThatAreStillToCome) {
  // At contraction 0.95 the changes still to come are 19 times the last one.
  const std::vector<IterationSummary> history = {summary(10.0), summary(9.5)};
  EXPECT_DOUBLE_EQ(contraction(history), 0.95);
  EXPECT_NEAR(estimate_error(history, emitted).iteration_bound, 9.5 * 19.0 / 100.0, 1e-9);
}

TEST(ErrorEstimate, AChangeThatFellByLuckIsBoundedByWhatIsReflected) {
  const std::vector<IterationSummary> history = {summary(10.0, 90.0), summary(0.01, 90.0)};
  const ErrorEstimate estimate = estimate_error(history, emitted);
  EXPECT_NEAR(estimate.iteration_bound, 0.01 * 9.0 / 100.0, 1e-9);
  EXPECT_LT(estimate.iteration, 0.01 * estimate.iteration_bound);
}

TEST(ErrorEstimate, WhatTheCoarseSystemLeavesIsBoundedByTheWorstOfThreeRatiosInPairs) {
  std::vector<IterationSummary> history;
  for (const double change : {10.0, 3.0, 1.2, 0.1}) history.push_back(summary(change, 99.0));
  EXPECT_DOUBLE_EQ(contraction(history), 0.99);  // nothing took the slow part out
  for (IterationSummary& s : history) s.corrected = true;
  const double pair = std::sqrt(0.4 * 0.3);
  EXPECT_DOUBLE_EQ(contraction(history), pair);
  history.back().missing_power = 0.3;
  EXPECT_NEAR(estimate_error(history, emitted).iteration_bound,
              (0.1 * pair / (1.0 - pair) + 0.3) / 100.0, 1e-9);
  history.back().figures.work.links_refined = 1;  // other links: too little is known of them
  EXPECT_DOUBLE_EQ(contraction(history), 0.99);
}

TEST(ErrorEstimate, ChangesThatAlternateDoNotSeemEndless) {
  std::vector<IterationSummary> history;
  for (const double change : {10.0, 1.0, 1.2, 0.12}) history.push_back(summary(change, 99.0));
  for (IterationSummary& s : history) s.corrected = true;
  EXPECT_NEAR(contraction(history), std::sqrt(1.2 * 0.1), 1e-12);
}

TEST(ErrorEstimate, AChangeThatAMendMadeIsPassedOnByReflection) {
  std::vector<IterationSummary> history = {summary(0.1), summary(1.0)};
  EXPECT_GT(estimate_error(history, emitted).iteration_bound, 10.0);  // it grew: no end in sight
  history.back().plan.flux_correction = {0.1};
  EXPECT_NEAR(estimate_error(history, emitted).iteration_bound, 0.01, 1e-9);
  EXPECT_NEAR(estimate_error(history, emitted).iteration, 0.01, 1e-9);
}

TEST(ErrorEstimate, TakesTheNoiseOfTheSamplesOut) {
  std::vector<IterationSummary> history = {summary(1.0), summary(0.0)};
  history.back().plan.sample = true;
  history.back().plan.sample_rays = 64;
  history.back().figures.error_samples = {{10.0}, {0.1}, {0.5}, {0.3}};
  // What is off on the patches, and half of a third of that: what they reflect of each other's.
  // Nor does a residual of 0.04 say more than that beside noise that can hide a tenth of itself.
  const double residual = std::hypot(0.04, 0.1 * 0.03);
  EXPECT_NEAR(estimate_error(history, emitted).patches, residual * (1.0 + 0.5 / 3.0), 1e-9);
  EXPECT_NEAR(sample_noise(history.back().figures.error_samples), 0.03, 1e-9);
  // A point gathered for sees half of it, as half of its light is reflected, and less for what
  // cancels.
  EXPECT_LT(estimate_error(history, emitted).total(), 0.02);
}

/// What all patches lack, a gather over many of them lacks as well: nothing cancels.
TEST(ErrorEstimate, WhatAllPatchesLackDoesNotCancelAtPoints) {
  std::vector<IterationSummary> history = {summary(1.0), summary(0.0)};
  history.back().plan.sample = true;
  history.back().figures.error_samples = {{10.0}, {3.0}, {3.0}, {0.0}, {0.0}};
  EXPECT_NEAR(estimate_error(history, emitted).total(), 0.5 * std::hypot(0.1, 0.3 / 0.5), 1e-9);
  history.back().figures.error_samples.surplus = {-3.0};  // too bright is no better
  EXPECT_NEAR(estimate_error(history, emitted).total(), 0.5 * std::hypot(0.1, 0.3 / 0.5), 1e-9);
  // Nine points that differ at random: their sum may be as far off by chance.
  history.back().figures.error_samples.surplus_variance = {9.0};
  EXPECT_NEAR(estimate_error(history, emitted).total(), 0.5 * 0.1, 1e-9);
}

TEST(ErrorEstimate, WhatOneBandIsOffByIsNotReflectedByAnother) {
  std::vector<IterationSummary> history = {summary(1.0), summary(0.0)};
  IterationFigures& figures = history.back().figures;
  history.back().plan.sample = true;
  figures.arriving_power = {100.0, 100.0};
  figures.returning_power = {10.0, 90.0};
  figures.absorbed_power = figures.escaping_power = figures.direct_power = {0.0, 0.0};
  figures.error_samples = {{10.0, 10.0}, {0.0, 0.0}, {0.6, 0.1}, {0.0, 0.0}};
  const ErrorEstimate estimate = estimate_error(history, {0.0, 0.0});
  EXPECT_NEAR(estimate.total(), 0.9 * 0.01 / 3.0, 1e-9);
  EXPECT_NEAR(estimate.patches, 0.06 * (1.0 + 0.1 / 3.0), 1e-9);
}

/// As points that are gathered for: a noisy one gets more rays.
TEST(ErrorEstimate, NoiseIsNoMoreThanGatheredPointsAreLeftWith) {
  std::vector<IterationSummary> history = {summary(1.0), summary(0.0)};
  history.back().plan.sample = true;
  history.back().plan.sample_rays = 4096;
  history.back().figures.error_samples = {{10.0}, {0.0}, {0.1}, {0.1}};  // 1%
  const double some = estimate_error(history, emitted).total();
  EXPECT_LT(some, 0.005);
  history.back().figures.error_samples.off =
      history.back().figures.error_samples.noise = {0.8};  // 8%
  EXPECT_GT(estimate_error(history, emitted).total(), 0.015);
}

TEST(ErrorEstimate, FollowsTheLinksAfterTheLastSamples) {
  std::vector<IterationSummary> history = {summary(1.0), summary(0.0), summary(0.0)};
  history[1].plan.sample = true;
  history[1].figures.error_samples = {{10.0}, {0.1}, {0.4}, {0.0}};
  history[1].figures.link_error_power = 20.0;
  history[2].figures.link_error_power = 5.0;
  EXPECT_NEAR(estimate_error(history, emitted).patches, 0.01 * (1.0 + 0.5 / 3.0), 1e-9);
}

TEST(ErrorEstimate, LightThatIsNeitherAbsorbedNorLeavingIsAnError) {
  std::vector<IterationSummary> history = {summary(1.0), summary(0.0)};
  history.back().figures.absorbed_power = {45.0};
  EXPECT_NEAR(estimate_error(history, emitted).patches, 0.1 * (1.0 + 0.5), 1e-9);
  history.back().figures.escaping_power = {5.0};
  EXPECT_NEAR(estimate_error(history, emitted).patches, 0.0, 1e-9);
}

}  // namespace
}  // namespace enfilade
