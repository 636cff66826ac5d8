#include "solver/energy_conservation.hpp"

#include <gtest/gtest.h>

namespace enfilade {
namespace {

/// Surfaces send out 50, of which `absorbed` comes to rest; 4 of the received light is in doubt.
IterationSummary still(double absorbed) {
  IterationSummary s;
  s.plan.close_rows = true;
  s.figures.absorbed_power = {absorbed};
  s.figures.escaping_power = s.figures.direct_power = {0.0};
  s.figures.uncertain_power = {4.0};
  s.figures.arriving_power = {100.0};
  s.figures.received_power = 100.0;
  return s;
}
const Spectrum surfaces{50.0};

/// After one iteration without the coarse correction.
Spectrum correction_after(const IterationSummary& last) {
  return flux_correction({&last, 1}, surfaces, 1e-3);
}

TEST(LightBalance, WhatIsLostIsMendedByTheShareOfTheDoubt) {
  EXPECT_EQ(correction_after(still(49.0)), Spectrum{0.25});
  EXPECT_EQ(correction_after(still(51.0)), Spectrum{-0.25});
  IterationSummary again = still(49.9);
  again.plan.flux_correction = {0.25};
  EXPECT_NEAR(correction_after(again).front(), 0.275, 1e-12);
  EXPECT_EQ(correction_after(still(49.99)), Spectrum{});  // near enough
}

TEST(LightBalance, NoMoreIsMendedThanIsInDoubt) {
  EXPECT_EQ(correction_after(still(40.0)), Spectrum{1.0});
  EXPECT_EQ(correction_after(still(60.0)), Spectrum{-1.0});
}

TEST(LightBalance, LightThatLeavesOrStillMovesIsNotLost) {
  IterationSummary open = still(49.0);
  open.figures.escaping_power = {2.0};
  EXPECT_EQ(correction_after(open), Spectrum{});
  IterationSummary moving = still(49.0);
  moving.error.iteration = 0.01;
  EXPECT_EQ(correction_after(moving), Spectrum{});
  IterationSummary early = still(49.0);
  early.plan.close_rows = false;
  EXPECT_EQ(correction_after(early), Spectrum{});
}

/// Iterations with the coarse correction whose lost power goes `kept` of the way from its end in
/// each; 4 is in doubt, so that a correction c moves the end by 4 c.
TEST(LightBalance, WhatWillBeLostInTheEndIsForetoldFromThreeIterations) {
  const double kept = 0.6, in_the_end = 3.0;
  std::vector<IterationSummary> history;
  double lost = 0.5, correction = 0.0;
  for (int i = 0; i < 8; ++i) {
    lost = kept * lost + (1.0 - kept) * (in_the_end - 4.0 * correction);
    history.push_back(still(50.0 - lost));
    history.back().corrected = true;
    if (correction != 0.0) history.back().plan.flux_correction = {correction};
    const Spectrum next = flux_correction(history, surfaces, 1e-6);
    correction = next.empty() ? 0.0 : next.front();
    if (i == 0) {
      EXPECT_EQ(correction, 0.0);  // one iteration tells nothing
    }
  }
  EXPECT_NEAR(correction, in_the_end / 4.0, 0.02);
}

TEST(LightBalance, PointLightsBringInWhatArrivesOfTheirs) {
  Scene scene;
  scene.bands = 1;
  scene.lights.push_back({Vec3(0.0), {1.0}});
  const Spectrum emitted{50.0 + 12.566370614359172};
  EXPECT_NEAR(surfaces_power(scene, emitted).bands.front(), 50.0, 1e-12);
  IterationSummary lit = still(60.0);
  lit.figures.direct_power = {10.0};
  EXPECT_NEAR(unbalanced_share(lit.figures, surfaces, 0), 0.0, 1e-12);
}

}  // namespace
}  // namespace enfilade
