#include "bounds/factors/inverse_power.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace enfilade {
namespace {

TEST(InversePower, PolynomialsLieOnEitherSide) {
  for (const double power : {-1.5, -2.0}) {
    for (const bool cubic : {false, true}) {
      for (const double most : {1.0001, 1.1, 2.0, 4.0}) {
        const PowerBounds bounds = bound_power(power, 1.0, most, cubic);
        for (int i = 0; i <= 1000; ++i) {
          const double s = 1.0 + (most - 1.0) * i / 1000.0, exact = std::pow(s, power);
          EXPECT_LE(bounds.below(s), exact * (1.0 + 1e-9)) << power << ' ' << most << ' ' << s;
          EXPECT_GE(bounds.above(s), exact * (1.0 - 1e-9)) << power << ' ' << most << ' ' << s;
        }
      }
    }
  }
}

TEST(InversePower, CubicsCloseInWithTheFourthPowerOfTheWidth) {
  const auto gap = [](double d) {
    const PowerBounds bounds = bound_power(-2.0, 1.0 - d, 1.0 + d, true);
    double most = 0.0;
    for (int i = 0; i <= 200; ++i) {
      const double s = 1.0 - d + 2.0 * d * i / 200.0;
      most = std::max(most, bounds.above(s) - bounds.below(s));
    }
    return most;
  };
  EXPECT_NEAR(gap(0.1) / gap(0.05), 16.0, 2.0);
  EXPECT_LT(gap(0.1), 3.0 * 1.25e-4);
}

}  // namespace
}  // namespace enfilade
