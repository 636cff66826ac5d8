#include "gather/extrapolate.hpp"

#include <gtest/gtest.h>

#include "unit/gather/box_room.hpp"

namespace enfilade {
namespace {

/// A floor in two halves of 3 m2 each, lit by 1 and 2.
ClusterState two_halves() {
  const Scene scene = testing::box_room({0, 0, 0}, {3, 2, 1}, {0.5}, {0.0});
  ClusterState state(testing::clusters_of(scene)[0], scene, Basis::constant);
  const std::size_t first = state.patches().subdivide(0);
  state.patches().irradiance(first)[0] = 1.0;
  state.patches().irradiance(first + 1)[0] = 2.0;
  state.patches().pull();
  return state;
}

TEST(Extrapolate, ChangesHowTheLightLiesAndNotItsPower) {
  ClusterState state = two_halves();
  EXPECT_NEAR(arriving_power(state)[0], 9.0, 1e-12);
  // Earlier there was a third as much light, 0.95 and 2.05 when scaled to what there is now.
  extrapolate(state, std::vector<double>{0.95 / 3.0, 2.05 / 3.0}, 1.5);
  EXPECT_NEAR(state.patches().irradiance(1)[0], 0.95 + 1.5 * 0.05, 1e-6);
  EXPECT_NEAR(state.patches().irradiance(2)[0], 2.05 - 1.5 * 0.05, 1e-6);
  EXPECT_NEAR(arriving_power(state)[0], 9.0, 1e-6);
  EXPECT_NEAR(state.patches().radiosity(0)[0], 0.75, 1e-7);
}

TEST(Extrapolate, LeavesAloneWhatIsFarFromItsRest) {
  ClusterState state = two_halves();
  extrapolate(state, {}, 1.25);
  EXPECT_EQ(state.patches().irradiance(1)[0], 1.0);
  extrapolate(state, std::vector<double>{2.0, 1.0}, 1.9);
  EXPECT_EQ(state.patches().irradiance(1)[0], 1.0);
  EXPECT_EQ(state.patches().irradiance(2)[0], 2.0);
}

}  // namespace
}  // namespace enfilade
