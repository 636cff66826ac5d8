#include "schemes/shares/relaxation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace enfilade {
namespace {

/// What is left of an error along an eigenvector of eigenvalue x after a cycle: the product of
/// 1 - w (1 - x).
double left_of(const ChebyshevCycle& cycle, double x) {
  double left = 1.0;
  for (int i = 0; i < ChebyshevCycle::length; ++i) left *= 1.0 - cycle.factor(i) * (1.0 - x);
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
  const ChebyshevCycle cycle(radius);
  const int n = ChebyshevCycle::length;
  for (double x = -0.99; x < 1.0; x += 0.03) {
    EXPECT_NEAR(left_of(cycle, x), chebyshev(n, x / radius) / chebyshev(n, 1.0 / radius), 1e-9)
        << x;
  }
}

TEST(ChebyshevCycle, ReducesAllErrorsBelowTheRadiusFarMoreThanJacobi) {
  const ChebyshevCycle cycle(0.8);
  const double most = 1.0 / chebyshev(ChebyshevCycle::length, 1.0 / 0.8);
  EXPECT_LT(most, 0.08 * std::pow(0.8, ChebyshevCycle::length));
  for (double x = -0.8; x <= 0.8; x += 0.01) EXPECT_LE(std::abs(left_of(cycle, x)), most + 1e-12);
}

TEST(ChebyshevCycle, StillReducesWhatLiesBeyondTheRadius) {
  const ChebyshevCycle cycle(0.3);
  for (const double x : {-0.95, 0.5, 0.9, 0.99}) EXPECT_LT(std::abs(left_of(cycle, x)), 1.0) << x;
}

TEST(ChebyshevCycle, FindsTheRadiusByWhatIsLeft) {
  for (const double truth : {0.5, 0.8, 0.95}) {
    ChebyshevCycle cycle(0.3);
    cycle.measure(std::abs(left_of(cycle, truth)));
    EXPECT_NEAR(cycle.radius(), truth, 1e-9);
  }
}

TEST(ChebyshevCycle, KeepsTheRadiusWhereItReducesAsItShould) {
  ChebyshevCycle cycle(0.6);
  cycle.measure(1e-6);
  EXPECT_EQ(cycle.radius(), 0.6);
}

TEST(ChebyshevCycle, BeginsAgain) {
  const ChebyshevCycle cycle(0.6);
  EXPECT_EQ(cycle.factor(3), cycle.factor(3 + ChebyshevCycle::length));
}

}  // namespace
}  // namespace enfilade
