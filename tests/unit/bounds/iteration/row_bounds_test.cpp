#include "bounds/iteration/row_bounds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "base/random.hpp"

namespace enfilade {
namespace {

/// Light without a spread: each point has the mean.
LightRange flat(double lo, double hi) { return {{lo, hi}, {lo, hi}, 0.5 * (hi - lo)}; }

BoundLink link(std::uint32_t shooter, double lo, double hi) {
  BoundLink l;
  l.shooter = shooter;
  l.factor.mean = {lo, hi};
  l.factor.at_points = {0.5 * (lo + hi), Vec3(0.0), 0.5 * (hi - lo)};
  l.factor.mean_spread = l.factor.point_spread = 1e300;
  return l;
}

/// Iterates a row until its references are good.
LightRange settled(const BoundRow& row) {
  RowReference reference;
  LightRange e = bound_row(row, 0.2, reference);
  for (int i = 0; i < 60; ++i) e.intersect(bound_row(row, 0.02, reference));
  return e;
}

TEST(RowBounds, AFractionalKnapsackIsSolved) {
  // Factors in [0.2, 0.6] and [0.3, 0.5] of light 10 and 1: at most 0.6 and 0.4; without a closed
  // row at least 0.2 and 0.3, in a closed one 0.5 and 0.5.
  const std::vector<BoundLink> links{link(0, 0.2, 0.6), link(1, 0.3, 0.5)};
  const std::vector<LightRange> light{flat(10.0, 10.0), flat(1.0, 1.0)};
  BoundRow row{.links = links, .radiosity = light};
  EXPECT_NEAR(settled(row).mean.hi, 0.6 * 10 + 0.4, 0.01);
  EXPECT_NEAR(settled(row).mean.lo, 0.2 * 10 + 0.3, 1e-9);
  row.closed = true;
  EXPECT_NEAR(settled(row).mean.hi, 0.6 * 10 + 0.4, 0.01);
  EXPECT_NEAR(settled(row).mean.lo, 0.5 * 10 + 0.5, 0.01);
}

TEST(RowBounds, EqualLightInAClosedRowNeedsNoFactors) {
  const std::vector<BoundLink> links{link(0, 0.0, 1.0), link(1, 0.0, 1.0)};
  const std::vector<LightRange> light{flat(7.0, 7.0), flat(7.0, 7.0)};
  const BoundRow row{.links = links, .radiosity = light, .closed = true};
  EXPECT_NEAR(settled(row).mean.lo, 7.0, 1e-6);
  EXPECT_NEAR(settled(row).mean.hi, 7.0, 1e-6);
}

TEST(RowBounds, HoldRandomRowsWhateverTheReference) {
  Random random(5);
  for (int trial = 0; trial < 2000; ++trial) {
    const auto count = static_cast<std::uint32_t>(1 + random.below(6));
    std::vector<double> factor(count), value(count);
    std::vector<BoundLink> links;
    std::vector<LightRange> light;
    double sum = 0.0, e = 0.0;
    for (double& f : factor) sum += f = random.uniform();
    const bool closed = random.uniform() < 0.5;
    const double whole = closed ? sum : sum * (1.0 + random.uniform());
    for (std::uint32_t k = 0; k < count; ++k) {
      factor[k] /= whole;
      value[k] = 10.0 * random.uniform();
      e += factor[k] * value[k];
      links.push_back(link(k, factor[k] * random.uniform(), factor[k] * (1.0 + random.uniform())));
      light.push_back(flat(value[k] * random.uniform(), value[k] * (1.0 + random.uniform())));
    }
    const BoundRow row{.links = links, .radiosity = light, .closed = closed};
    RowReference reference{10.0 * random.uniform(), 10.0 * random.uniform(),
                           10.0 * random.uniform(), 10.0 * random.uniform()};
    const LightRange bound = bound_row(row, 0.1, reference);
    ASSERT_LE(bound.mean.lo, e + 1e-9);
    ASSERT_GE(bound.mean.hi, e - 1e-9);
    ASSERT_LE(bound.at_points.lo, e + 1e-9);
    ASSERT_GE(bound.at_points.hi, e - 1e-9);
  }
}

TEST(RowBounds, AWallOfManyPartsIsBoundAsAWhole) {
  // Two parts of one wall of uniform light, whose factors are known together only.
  const std::vector<BoundLink> links{link(0, 0.0, 0.5), link(1, 0.0, 0.5), link(2, 0.5, 0.5)};
  const std::vector<LightRange> light{flat(4.0, 4.0), flat(4.0, 4.0), flat(2.0, 2.0)};
  std::vector<BoundWall> walls(1);
  walls[0].whole = link(0, 0.45, 0.5).factor;
  walls[0].end = 2;
  BoundRow row{.links = links, .radiosity = light};
  EXPECT_NEAR(settled(row).mean.lo, 1.0, 1e-9);
  row.walls = walls;
  EXPECT_NEAR(settled(row).mean.lo, 0.45 * 4.0 + 1.0, 1e-9);
}

}  // namespace
}  // namespace enfilade
