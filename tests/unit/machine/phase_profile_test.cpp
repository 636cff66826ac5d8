#include "machine/phase_profile.hpp"

#include <gtest/gtest.h>

namespace enfilade {
namespace {

double seconds(const PhaseProfile& profile, Phase phase) {
  double sum = 0.0;
  for (const auto& bin : profile.bins()) sum += bin[static_cast<std::size_t>(phase)];
  return sum;
}

TEST(PhaseProfile, ASpanIsSharedOutOverItsBins) {
  PhaseProfile profile(1.0);
  profile.add(Phase::io, 0.5, 2.25);
  ASSERT_EQ(profile.bins().size(), 3u);
  EXPECT_DOUBLE_EQ(profile.bins()[0][1], 0.5);
  EXPECT_DOUBLE_EQ(profile.bins()[1][1], 1.0);
  EXPECT_DOUBLE_EQ(profile.bins()[2][1], 0.25);
}

TEST(PhaseProfile, HoweverLongTheRunNoSecondIsLost) {
  PhaseProfile profile;
  double at_s = 0.0;
  for (int i = 0; i < 10000; ++i) {
    profile.add(Phase::compute, at_s, at_s + 2.0);
    profile.add(Phase::token, at_s + 2.0, at_s + 3.0);
    at_s += 3.0;
  }
  EXPECT_LE(profile.bins().size(), PhaseProfile::most_bins);
  EXPECT_GT(profile.bins().size(), PhaseProfile::most_bins / 4);
  EXPECT_NEAR(seconds(profile, Phase::compute), 20000.0, 1e-6);
  EXPECT_NEAR(seconds(profile, Phase::token), 10000.0, 1e-6);
}

TEST(PhaseProfile, WidensByDoubling) {
  PhaseProfile profile(1.0);
  profile.add(Phase::wait, 0.0, 5.0);
  profile.widen(3.0);
  EXPECT_DOUBLE_EQ(profile.bin_s(), 4.0);
  ASSERT_EQ(profile.bins().size(), 2u);
  EXPECT_DOUBLE_EQ(profile.bins()[0][4], 4.0);
  EXPECT_DOUBLE_EQ(profile.bins()[1][4], 1.0);
}

}  // namespace
}  // namespace enfilade
