#include "solver/iteration_plan.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"

namespace enfilade {
namespace {

/// An iteration that has settled; `bound`: what iterations to come can change at most.
IterationSummary summary(int iteration, double bound, double links_refined = 0.0) {
  IterationSummary s;
  s.plan.iteration = iteration;
  s.plan.close_rows = true;
  s.error.iteration_bound = bound;
  s.figures.change_power = 100.0 * bound;
  s.figures.received_power = 100.0;
  s.figures.links = 10000;
  s.figures.work.links_refined = static_cast<std::uint64_t>(links_refined);
  return s;
}
IterationSummary sampled(int iteration, double patch_error) {
  IterationSummary s = summary(iteration, 0.0);
  s.plan.sample = true;
  s.plan.refine = false;
  s.error.patches = patch_error;
  return s;
}

const PlanConfig plan_settings{.emitted_power = {10.0, 1.0},
                               .surfaces_power = {},
                               .epsilon = 1e-3,
                               .tolerance = 1e-4,
                               .max_iterations = 50};

TEST(IterationPlan, LinkToleranceIsAShareOfTheEmittedPower) {
  EXPECT_DOUBLE_EQ(first_plan(plan_settings).link_tolerance, 0.01);
  EXPECT_EQ(first_plan(plan_settings).iteration, 1);
  EXPECT_FALSE(first_plan(plan_settings).finished);
}

TEST(IterationPlan, SamplesOnceTheLightIsStillThenEnds) {
  std::vector<IterationSummary> history = {summary(1, 0.5, 9000), summary(2, 5e-5)};
  const IterationPlan sampling = next_plan(history, plan_settings);
  EXPECT_FALSE(sampling.finished);
  EXPECT_TRUE(sampling.sample);
  EXPECT_FALSE(sampling.refine);
  EXPECT_GE(sampling.sample_rays, 64);

  history.push_back(sampled(3, 0.01));
  const IterationPlan plan = next_plan(history, plan_settings);
  EXPECT_TRUE(plan.finished);
  EXPECT_TRUE(plan.converged);
  EXPECT_EQ(plan.iteration, 4);
}

TEST(IterationPlan, GoesOnWhileLinksAreRefinedOrLightMoves) {
  const std::vector<IterationSummary> refining = {summary(1, 0.5, 9000), summary(2, 5e-5, 5000)};
  EXPECT_FALSE(next_plan(refining, plan_settings).finished);
  EXPECT_FALSE(next_plan(refining, plan_settings).sample);
  const std::vector<IterationSummary> moving = {summary(1, 0.5, 9000), summary(2, 0.01)};
  EXPECT_FALSE(next_plan(moving, plan_settings).finished);
  EXPECT_FALSE(next_plan(moving, plan_settings).sample);
}

TEST(IterationPlan, RowsOnceClosedStayClosed) {
  std::vector<IterationSummary> history = {summary(1, 0.5, 9000)};
  history.back().plan.close_rows = false;
  EXPECT_FALSE(next_plan(history, plan_settings).close_rows);
  history.push_back(summary(2, 0.05));
  EXPECT_TRUE(next_plan(history, plan_settings).close_rows);
  history.push_back(summary(3, 0.2));  // closing them has moved the light by more than that
  EXPECT_TRUE(next_plan(history, plan_settings).close_rows);
}

TEST(IterationPlan, GivesUpAtTheLimitAndSaysSo) {
  const std::vector<IterationSummary> history = {summary(49, 0.6), summary(50, 0.5)};
  const IterationPlan plan = next_plan(history, plan_settings);
  EXPECT_TRUE(plan.finished);
  EXPECT_FALSE(plan.converged);
}

TEST(IterationPlan, RefinesUntilTheAskedErrorIsEstimated) {
  const PlanConfig asked{
      .emitted_power = {10.0}, .surfaces_power = {}, .target_error = 0.02, .max_iterations = 50};
  std::vector<IterationSummary> history = {summary(1, 0.5, 9000), summary(2, 5e-5),
                                           sampled(3, 0.5)};  // half of the light: far above 2%
  for (IterationSummary& s : history) s.plan.link_tolerance = 1e-3;
  const IterationPlan finer = next_plan(history, asked);
  EXPECT_FALSE(finer.finished);
  EXPECT_LT(finer.link_tolerance, 0.7 * 1e-3 + 1e-12);
  EXPECT_TRUE(finer.refine);

  history.back() = sampled(3, 0.01);
  EXPECT_TRUE(next_plan(history, asked).converged);

  // A finer tolerance that finds nothing left to refine: it ends, and says that it did not get
  // there.
  history.back() = sampled(3, 0.5);
  history.push_back(summary(4, 5e-5));
  history.back().plan.link_tolerance = 0.5e-3;
  history.back().error.patches = 0.5;
  const IterationPlan stuck = next_plan(history, asked);
  EXPECT_TRUE(stuck.finished);
  EXPECT_FALSE(stuck.converged);
}

/// At a high reflectance the light grows while links are refined, and the tolerance with it.
TEST(IterationPlan, TheToleranceFollowsLightThatHasDoubled) {
  const PlanConfig asked{
      .emitted_power = {10.0}, .surfaces_power = {}, .target_error = 0.02, .max_iterations = 50};
  const double first = first_plan(asked).link_tolerance;
  const auto tolerance = [&](double growth, bool sampled_before) {
    std::vector<IterationSummary> history = {summary(1, 0.5, 9000)};
    if (sampled_before) history.push_back(sampled(2, 0.5));
    history.push_back(summary(3, 0.01, 9000));
    for (IterationSummary& s : history) s.plan.link_tolerance = first;
    history.back().figures.received_power = growth * 10.0;
    history.back().figures.change_power = 0.1;
    return next_plan(history, asked).link_tolerance;
  };
  EXPECT_DOUBLE_EQ(tolerance(2.5, false), 2.5 * first);
  EXPECT_DOUBLE_EQ(tolerance(1.5, false), first);
  EXPECT_DOUBLE_EQ(tolerance(2.5, true), first);
}

/// Ten buildings beside each other are as fine as one: the tolerance is that of one building's
/// power.
TEST(IterationPlan, PartsOfALargeBuildingAreAsFineAsASmallOne) {
  const double clusters = 2.0 * PlanWeights{}.clusters_at_first_epsilon;
  const auto tolerance = [clusters](double copies) {
    const PlanConfig asked{.emitted_power = {10.0 * copies},
                           .surfaces_power = {},
                           .target_error = 0.02,
                           .clusters = static_cast<std::size_t>(clusters * copies)};
    return first_plan(asked).link_tolerance;
  };
  EXPECT_NEAR(tolerance(10.0) / tolerance(1.0), 1.0, 1e-12);
  EXPECT_NEAR(tolerance(0.01) / tolerance(1.0), 0.02, 1e-12);  // small ones: by their power alone
}

/// Finer links that bring less than they should end the refinement, unless the target is near.
TEST(IterationPlan, SlowRefinementGoesOnWhereTheTargetIsNear) {
  const PlanConfig asked{
      .emitted_power = {10.0}, .surfaces_power = {}, .target_error = 0.02, .max_iterations = 50};
  const auto plan = [&](double before, double error) {
    std::vector<IterationSummary> history = {summary(1, 0.5, 9000), summary(2, 5e-5),
                                             sampled(3, before), summary(4, 5e-5, 9000),
                                             sampled(5, error)};
    for (IterationSummary& s : history) {
      s.plan.link_tolerance = s.plan.iteration < 4 ? 1e-3 : 1e-4;
      s.figures.links = 1'000'000;  // patches are not held to the target
    }
    history[2].error.discretisation = before;
    history[4].error.discretisation = error;
    return next_plan(history, asked);
  };
  // Ten times finer brought less than the sixth root of ten. At that rate, eight times finer once
  // more makes 1.6% of 2.2%, and 2.5% of 3.5%.
  EXPECT_FALSE(plan(0.032, 0.022).finished);
  EXPECT_TRUE(plan(0.05, 0.035).finished);
  EXPECT_FALSE(plan(0.05, 0.035).converged);
  EXPECT_TRUE(plan(0.02, 0.022).finished);
  EXPECT_FALSE(plan(0.05, 0.03).finished);  // as fast as it should
}

TEST(IterationPlan, PatchesAreHeldToTheTargetWhileTheLinksAreFew) {
  PlanConfig asked{
      .emitted_power = {10.0}, .surfaces_power = {}, .target_error = 0.02, .max_iterations = 50};
  std::vector<IterationSummary> history = {summary(1, 0.5, 9000), summary(2, 5e-5),
                                           sampled(3, 0.06)};
  history.back().error.discretisation = 0.015;
  history.back().plan.link_tolerance = 1e-4;
  asked.patch_links = 2 * history.back().figures.links;
  const IterationPlan finer = next_plan(history, asked);
  EXPECT_FALSE(finer.finished);
  // The step aims at patch_links links, and not beyond.
  EXPECT_NEAR(finer.link_tolerance / history.back().plan.link_tolerance, std::pow(0.5, 1.5), 1e-9);
  asked.patch_links = history.back().figures.links;
  EXPECT_TRUE(next_plan(history, asked).converged);
  history.back().error.discretisation = 0.05;  // gathered light is held to it all the same
  EXPECT_FALSE(next_plan(history, asked).finished);
}

/// Of n stratified rays, 0.5 n^(-3/4) is the standard deviation at most: 0.3 of a coarse target.
TEST(IterationPlan, RaysOfOpennessFollowTheTarget) {
  PlanConfig config{
      .emitted_power = {10.0}, .surfaces_power = {}, .target_error = 0.3, .max_iterations = 50};
  const IterationPlan coarse = first_plan(config);
  const double rays = 4.0 * coarse.openness_rays.rings * coarse.openness_rays.rings;
  EXPECT_LT(rays, 64.0);
  EXPECT_LT(0.5 * std::pow(rays, -0.75), 0.3 * 0.3);
  config.target_error = 0.02;
  const IterationPlan fine = first_plan(config);
  EXPECT_EQ(fine.openness_rays.rings, 4);
  EXPECT_GT(fine.openness_rays.per_cluster, 4.0 * coarse.openness_rays.per_cluster);
  // A run that goes on with a finer target measures what is new as finely as that.
  IterationSummary begun = summary(1, 1.0, 12);
  begun.plan = coarse;
  EXPECT_EQ(next_plan(std::vector{begun}, config).openness_rays.rings, 4);
  config.target_error = 0.3;
  begun.plan = fine;
  EXPECT_EQ(next_plan(std::vector{begun}, config).openness_rays.rings, 4);
}

TEST(IterationPlan, NumbersComeBackAsTheyWere) {
  IterationSummary s = summary(7, 0.03125, 12);
  s.plan.link_tolerance = 0.125;
  s.plan.refine = false;
  s.error = {0.1, 0.2, 0.3, 0.4, 0.5};
  s.plan.sample_rays = 99;
  s.plan.openness_rays = {3, 200.0};
  s.plan.flux_correction = {0.5, -0.25};
  s.time_s = 9.0;
  s.correction_failed = true;
  s.figures.rows.add(2.0, 0.75, 1.0);
  s.figures.max_change = 0.75;
  s.figures.steals = 3;
  s.figures.work.rays = 1234567890123;
  s.figures.work.shafts = 8;
  double next = 1.0;
  for (Spectrum* spectrum :
       {&s.figures.arriving_power, &s.figures.returning_power, &s.figures.absorbed_power,
        &s.figures.escaping_power, &s.figures.direct_power, &s.figures.uncertain_power,
        &s.figures.error_samples.light, &s.figures.error_samples.surplus,
        &s.figures.error_samples.off, &s.figures.error_samples.noise,
        &s.figures.error_samples.surplus_variance}) {
    *spectrum = {next, next + 0.25};
    next += 1.0;
  }
  const IterationSummary back = summary_from(to_numbers(s));
  EXPECT_EQ(to_numbers(back), to_numbers(s));
  EXPECT_EQ(back.plan.iteration, 7);
  EXPECT_EQ(back.plan.openness_rays.rings, 3);
  EXPECT_EQ(back.plan.openness_rays.per_cluster, 200.0);
  EXPECT_FALSE(back.plan.refine);
  EXPECT_TRUE(back.correction_failed);
  EXPECT_EQ(back.figures.rows.deficit_m2, 0.5);
  EXPECT_EQ(back.figures.rows.area_by_ratio, s.figures.rows.area_by_ratio);
  EXPECT_EQ(back.figures.work.rays, 1234567890123u);
  EXPECT_EQ(back.figures.work.shafts, 8u);
  EXPECT_EQ(back.error.iteration_bound, 0.5);
  EXPECT_EQ(back.plan.sample_rays, 99);
  EXPECT_EQ(back.plan.flux_correction, s.plan.flux_correction);
  EXPECT_EQ(back.figures.absorbed_power, s.figures.absorbed_power);
  EXPECT_EQ(back.figures.error_samples.noise, s.figures.error_samples.noise);
  EXPECT_EQ(back.figures.escaping_power, s.figures.escaping_power);
  EXPECT_THROW(summary_from(std::vector<double>(9, 1.0)), RunError);
}

}  // namespace
}  // namespace enfilade
