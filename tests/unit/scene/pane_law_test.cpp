// The law of a pane against Fresnel's equations in another form, and the sum of all reflections.
#include "scene/pane_law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace enfilade {
namespace {

double slab(double r) {
  double sum = 0.0, way = (1.0 - r) * (1.0 - r);
  for (int k = 0; k < 2000; ++k, way *= r * r) sum += way;
  return sum;
}

TEST(PaneLaw, IsFresnelsWithAllReflections) {
  const double head_on = slab(std::pow(0.52 / 2.52, 2));
  EXPECT_NEAR(clear_pane_transmittance(), head_on, 1e-12);
  EXPECT_NEAR(head_on, 0.9182, 1e-3);
  for (double angle = 1.0; angle < 89.5; angle += 1.0) {
    const double i = angle * std::numbers::pi / 180.0, t = std::asin(std::sin(i) / 1.52);
    const double across = std::pow(std::sin(i - t) / std::sin(i + t), 2);
    const double along = std::pow(std::tan(i - t) / std::tan(i + t), 2);
    const double expected = 0.5 * (slab(across) + slab(along)) / head_on;
    EXPECT_NEAR(pane_share(std::cos(i)), expected, 1e-9) << angle;
    EXPECT_NEAR(pane_share(-std::cos(i)), expected, 1e-9) << angle;
  }
}

TEST(PaneLaw, FallsFromNormalToGrazingIncidence) {
  EXPECT_DOUBLE_EQ(pane_share(1.0), 1.0);
  EXPECT_DOUBLE_EQ(pane_share(1.0 + 1e-12), 1.0);
  EXPECT_EQ(pane_share(0.0), 0.0);
  double before = 1.0;
  for (double c = 0.99; c > 0.0; c -= 0.01) {
    EXPECT_LT(pane_share(c), before + 1e-12) << c;
    before = pane_share(c);
  }
  // Brewster's angle: what is polarised along the plane of incidence passes whole.
  EXPECT_GT(pane_share(std::cos(std::atan(1.52))) * clear_pane_transmittance(), 0.5 * (1.0 + 0.7));
}

}  // namespace
}  // namespace enfilade
