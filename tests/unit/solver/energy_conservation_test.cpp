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

TEST(LightBalance, WhatIsLostIsMendedByTheShareOfTheDoubt) {
  EXPECT_EQ(flux_correction(still(49.0), surfaces, 1e-3), Spectrum{0.25});
  EXPECT_EQ(flux_correction(still(51.0), surfaces, 1e-3), Spectrum{-0.25});
  IterationSummary again = still(49.9);
  again.plan.flux_correction = {0.25};
  EXPECT_NEAR(flux_correction(again, surfaces, 1e-3).front(), 0.275, 1e-12);
  EXPECT_EQ(flux_correction(still(49.99), surfaces, 1e-3), Spectrum{});  // near enough
}

TEST(LightBalance, NoMoreIsMendedThanIsInDoubt) {
  EXPECT_EQ(flux_correction(still(40.0), surfaces, 1e-3), Spectrum{1.0});
  EXPECT_EQ(flux_correction(still(60.0), surfaces, 1e-3), Spectrum{-1.0});
}

TEST(LightBalance, LightThatLeavesOrStillMovesIsNotLost) {
  IterationSummary open = still(49.0);
  open.figures.escaping_power = {2.0};
  EXPECT_EQ(flux_correction(open, surfaces, 1e-3), Spectrum{});
  IterationSummary moving = still(49.0);
  moving.error.iteration = 0.01;
  EXPECT_EQ(flux_correction(moving, surfaces, 1e-3), Spectrum{});
  IterationSummary early = still(49.0);
  early.plan.close_rows = false;
  EXPECT_EQ(flux_correction(early, surfaces, 1e-3), Spectrum{});
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
