#include "radiosity/coarse_correction.hpp"

#include <gtest/gtest.h>

#include "box_room.hpp"

namespace enfilade {
namespace {

TEST(CoarseSystem, SolvesASmallSystemExactly) {
  // Two clusters that see each other fully: E1 = rho2 E2 + 1, E2 = rho1 E1; one Jacobi sweep from
  // zero has made E = (1, 0). The correction must lead to the fixed point at once.
  const double rho1 = 0.9, rho2 = 0.8;
  CoarseSystem system(2, 1);
  const std::vector<std::uint32_t> groups{0, 1};
  CoarseRow first, second;
  first.area_m2 = second.area_m2 = 3.0;
  first.change = {3.0 * 1.0};
  second.change = {0.0};
  first.entries = {{ClusterId(1u), true, {3.0 * rho2}}};
  second.entries = {{ClusterId(0u), true, {3.0 * rho1}}};
  system.add(0, first, groups);
  system.add(1, second, groups);
  const std::vector<double> d = CoarseSystem::from_numbers(system.to_numbers()).solve();
  const double e1 = 1.0 / (1.0 - rho1 * rho2), e2 = rho1 * e1;
  EXPECT_NEAR(1.0 + d[0], e1, 1e-5);
  EXPECT_NEAR(0.0 + d[1], e2, 1e-5);
  EXPECT_NEAR(system.power(d), 3.0 * (d[0] + d[1]), 1e-9);
}

TEST(CoarseCorrection, MakesIterationsIndependentOfReflectance) {
  for (const double rho : {0.5, 0.9, 0.99, 0.999}) {
    const testing::Solved with(testing::box_room({0, 0, 0}, {4, 4, 4}, {rho}, {1.0}), Basis::linear,
                               1e-3);
    EXPECT_LE(with.iterations, 12) << rho;
    EXPECT_NEAR(with.states[0].patches().irradiance(0)[0] * (1.0 - rho), 1.0, 1e-4) << rho;
  }
  const testing::Solved without(testing::box_room({0, 0, 0}, {4, 4, 4}, {0.9}, {1.0}),
                                Basis::linear, 1e-3, false);
  EXPECT_GT(without.iterations, 30);
}

}  // namespace
}  // namespace enfilade
