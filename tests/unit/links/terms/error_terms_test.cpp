#include "links/terms/error_terms.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace enfilade {
namespace {

/// The square [-1, 1]^2: its standard deviations are 1 / sqrt(3).
const PatchShape square = PatchShape::from({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}});

template <class F>
FourPointFit fit_to(F f) {
  std::array<double, 4> values{};
  const std::array<Vec2, 4> points = square.quadrature();
  for (std::size_t k = 0; k < 4; ++k) values[k] = f(points[k]);
  return FourPointFit::of(values);
}

/// Mean over the square of |f - fit|, or with `terms` = 1 of |f - mean|.
template <class F>
double mean_misfit(F f, const FourPointFit& fit, int terms) {
  const int n = 400;
  const double s = square.deviations().x;
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const Vec2 p{(2.0 * i + 1.0) / n - 1.0, (2.0 * j + 1.0) / n - 1.0};
      const double slopes = terms == 1 ? 0.0 : (fit.slope1 * p.x + fit.slope2 * p.y) / s;
      sum += std::abs(f(p) - fit.mean - slopes);
    }
  }
  return sum / (n * n);
}

TEST(FourPointFit, ReproducesAnAffineFunction) {
  const FourPointFit fit = fit_to([](Vec2 p) { return 2.0 + 3.0 * p.x - p.y; });
  EXPECT_NEAR(fit.mean, 2.0, 1e-12);
  EXPECT_NEAR(fit.slope1 / square.deviations().x, 3.0, 1e-12);
  EXPECT_NEAR(fit.slope2 / square.deviations().y, -1.0, 1e-12);
  EXPECT_NEAR(fit.saddle, 0.0, 1e-12);
}

TEST(ErrorTerms, EstimateTheMeanMisfitOfQuadratics) {
  const auto bowl = [](Vec2 p) { return p.x * p.x + p.y * p.y; };
  const FourPointFit fit = fit_to(bowl);
  EXPECT_NEAR(curvature_error(bowl({0, 0}), fit.mean) / mean_misfit(bowl, fit, 3), 1.0, 0.06);
  const auto mixed = [](Vec2 p) { return p.x * p.y; };
  EXPECT_NEAR(saddle_error(fit_to(mixed).saddle) / mean_misfit(mixed, fit_to(mixed), 3), 1.0, 0.08);
}

TEST(ErrorTerms, EstimateTheDeviationThatAConstantBasisLeavesOut) {
  for (const Vec2 g : {Vec2(1, 0), Vec2(0, -2), Vec2(1, 1), Vec2(-0.5, 1)}) {
    const auto slope = [g](Vec2 p) { return 1.0 + glm::dot(g, p); };
    const FourPointFit fit = fit_to(slope);
    EXPECT_NEAR(slope_error(fit.slope1, fit.slope2) / mean_misfit(slope, fit, 1), 1.0, 0.1);
    ReceiverSamples samples;
    samples.fit = fit;
    samples.center = 1.0;
    EXPECT_NEAR(receiver_error(samples, 3), 0.0, 1e-12);
    EXPECT_NEAR(receiver_error(samples, 1), slope_error(fit.slope1, fit.slope2), 1e-12);
  }
}

}  // namespace
}  // namespace enfilade
