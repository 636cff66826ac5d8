#include "radiosity/coarse_correction.hpp"

#include <gtest/gtest.h>

#include "box_room.hpp"

namespace enfilade {
namespace {

TEST(CoarseSystem, SolvesASmallSystemExactly) {
  // Two clusters of 3 m2 that see each other fully: E1 = rho2 E2 + 1, E2 = rho1 E1; three Jacobi
  // sweeps from zero have made E = (1, 0), (1, rho1), (1 + rho1 rho2, rho1). The correction must
  // lead to the fixed point at once.
  const double rho1 = 0.9, rho2 = 0.8, both = rho1 * rho2;
  CoarseSystem system(2, 1);
  const std::vector<std::uint32_t> groups{0, 1};
  CoarseRow first, second;
  first.absorbed = {1.0};
  first.escaping = {0.5};
  second.absorbed = {2.0};
  second.escaping = {0.25};
  first.before = {3.0};
  first.after = {3.0 * (1.0 + both)};
  second.before = second.after = {3.0 * rho1};
  first.entries = {{ClusterId(1u), true, {3.0 * both}}};
  second.entries = {{ClusterId(0u), true, {3.0 * rho1}}};
  system.add(0, first, groups);
  system.add(1, second, groups);
  const std::vector<double> x = CoarseSystem::from_numbers(system.to_numbers()).solve();
  const double e1 = 1.0 / (1.0 - both), e2 = rho1 * e1;
  EXPECT_NEAR((1.0 + both) * (1.0 + x[0]), e1, 1e-5);
  EXPECT_NEAR(rho1 * (1.0 + x[1]), e2, 1e-5);
  EXPECT_NEAR(system.power(x), 3.0 * (e1 - 1.0 - both + e2 - rho1), 1e-4);
  EXPECT_NEAR(system.absorbed(x).front(), x[0] + 2.0 * x[1], 1e-12);
  EXPECT_NEAR(system.escaping(x).front(), 0.5 * x[0] + 0.25 * x[1], 1e-12);
}

TEST(CoarseSystem, LightThatNobodyGivesDies) {
  // A sealed pair with light left over, which fades by a tenth a sweep: nothing comes in.
  CoarseSystem system(2, 1);
  const std::vector<std::uint32_t> groups{0, 1};
  CoarseRow row;
  row.before = row.absorbed = row.escaping = {1.0};
  row.after = {0.9};
  row.entries = {{ClusterId(1u), true, {0.9}}};
  system.add(0, row, groups);
  row.entries = {{ClusterId(0u), true, {0.9}}};
  system.add(1, row, groups);
  for (const double change : system.solve()) EXPECT_NEAR(change, -1.0, 1e-4);
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
