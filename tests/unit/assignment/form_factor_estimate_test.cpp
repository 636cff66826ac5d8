#include "assignment/form_factor_estimate.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace enfilade {
namespace {

Cluster ball(const Vec3& centre, double area_m2) {
  Cluster cluster;
  cluster.bounds.add(centre - Vec3(0.5));
  cluster.bounds.add(centre + Vec3(0.5));
  cluster.area_m2 = area_m2;
  return cluster;
}

TEST(FormFactorEstimate, IsAreaOverPiSquaredDistanceFromAfar) {
  const std::vector<Cluster> clusters{ball({0, 0, 0}, 2.0), ball({30, 40, 0}, 8.0)};
  const double expected = 4.0 / (std::numbers::pi * 2500.0);
  EXPECT_NEAR(FormFactorEstimate(clusters).between(0, 1), expected, 1e-3 * expected);
}

TEST(FormFactorEstimate, IsAFacingDisksFactor) {
  // A disk of radius r seen from its axis at distance d fills r^2 / (r^2 + d^2).
  const double r = 3.0, d = 2.0, area_m2 = std::numbers::pi * r * r;
  const std::vector<Cluster> clusters{ball({0, 0, 0}, area_m2), ball({0, 0, d}, area_m2)};
  EXPECT_NEAR(FormFactorEstimate(clusters).between(0, 1), r * r / (r * r + d * d), 1e-12);
}

TEST(FormFactorEstimate, IsSymmetricAndAtMostOne) {
  const std::vector<Cluster> clusters{ball({0, 0, 0}, 0.1), ball({0, 0, 0}, 90.0),
                                      ball({1, 2, 0}, 5.0)};
  const FormFactorEstimate estimate(clusters);
  EXPECT_DOUBLE_EQ(estimate.between(0, 1), 1.0);
  EXPECT_EQ(estimate.between(0, 2), estimate.between(2, 0));
  EXPECT_LT(estimate.between(0, 2), estimate.between(1, 2));
}

TEST(FormFactorEstimate, WithoutClustersWeighsHops) {
  EXPECT_EQ(FormFactorEstimate().between(3, 17), 1.0);
}

}  // namespace
}  // namespace enfilade
