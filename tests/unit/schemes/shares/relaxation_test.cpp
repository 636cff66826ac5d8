#include "schemes/shares/relaxation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace enfilade {
namespace {

/// What is left of an error along an eigenvector of eigenvalue x after a cycle: the product of
/// 1 - w (1 - x).
double left_of(const ChebyshevCycle& cycle, double x) {
  double left = 1.0;
  for (int i = 0; i < cycle.length(); ++i) left *= 1.0 - cycle.factor(i) * (1.0 - x);
  return left;
}

/// Chebyshev's polynomial by its recurrence.
double chebyshev(int n, double x) {
  double before = 1.0, now = x;
  for (int k = 1; k < n; ++k) {
    const double next = 2.0 * x * now - before;
    before = now;
    now = next;
  }
  return now;
}

TEST(ChebyshevCycle, LeavesOfEachEigenvalueWhatThePolynomialSays) {
  const double radius = 0.7;
  const ChebyshevCycle cycle(radius, 1e-4);
  const int n = cycle.length();
  for (double x = -0.99; x < 1.0; x += 0.03) {
    EXPECT_NEAR(left_of(cycle, x), chebyshev(n, x / radius) / chebyshev(n, 1.0 / radius), 1e-9)
        << x;
  }
}

TEST(ChebyshevCycle, IsAsLongAsItsAimNeeds) {
  for (const double aim : {1e-3, 1e-5, 1e-7}) {
    const ChebyshevCycle cycle(0.6, aim);
    EXPECT_LE(1.0 / chebyshev(cycle.length(), 1.0 / 0.6), aim);
    EXPECT_GT(1.0 / chebyshev(cycle.length() - 1, 1.0 / 0.6), aim);
    for (double x = -0.6; x <= 0.6; x += 0.01) EXPECT_LE(std::abs(left_of(cycle, x)), aim) << x;
    EXPECT_GT(std::pow(0.6, 1.7 * cycle.length()), aim) << "Jacobi would do as well";
  }
}

TEST(ChebyshevCycle, LetsNoPartialProductGrowLarge) {
  const ChebyshevCycle cycle(0.97, 1e-7);
  double most = 0.0;
  for (double x = -0.97; x <= 0.97; x += 0.01) {
    double left = 1.0;
    for (int i = 0; i < cycle.length(); ++i) {
      left *= 1.0 - cycle.factor(i) * (1.0 - x);
      most = std::max(most, std::abs(left));
    }
  }
  EXPECT_LT(most, 100.0);
}

TEST(ChebyshevCycle, StillReducesWhatLiesBeyondTheRadius) {
  const ChebyshevCycle cycle(0.3, 1e-5);
  for (const double x : {-0.95, 0.5, 0.9, 0.99}) EXPECT_LT(std::abs(left_of(cycle, x)), 1.0) << x;
}

TEST(ChebyshevCycle, FindsTheRadiusByWhatIsLeft) {
  for (const double truth : {0.5, 0.8, 0.95}) {
    const ChebyshevCycle cycle(0.3, 1e-5);
    EXPECT_NEAR(cycle.measured(std::abs(left_of(cycle, truth))), truth, 1e-9);
    EXPECT_EQ(cycle.measured(1e-7), 0.3) << "it has reduced the residual as it should";
  }
}

}  // namespace
}  // namespace enfilade
