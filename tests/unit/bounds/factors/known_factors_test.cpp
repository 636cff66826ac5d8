// Bounds of form factors against the public set: each interval holds the truth.
#include <gtest/gtest.h>

#include "bounds/factors/pair_factor.hpp"
#include "unit/known_factors.hpp"

namespace enfilade {
namespace {

TEST(PairFactors, HoldAllKnownFactors) {
  int pairs = 0, tight = 0;
  for (const testing::KnownFactor& known : testing::known_factors()) {
    if (known.from_point()) continue;
    std::vector<Polygon> all{known.receiver, known.shooter};
    all.insert(all.end(), known.occluders.begin(), known.occluders.end());
    const FlatShape receiver(all[0], plane_of(all[0])), shooter(all[1], plane_of(all[1]));
    const PairFactors factors(all);
    const PairFactor there = factors({receiver, 0}, {shooter, 1}, false);
    EXPECT_LE(there.mean.lo, known.factor + 1e-10) << known.name;
    EXPECT_GE(there.mean.hi, known.factor - 1e-10) << known.name;
    // And the other way, by reciprocity.
    const double back = known.factor * receiver.area_m2 / shooter.area_m2;
    const PairFactor from = factors({shooter, 1}, {receiver, 0}, false);
    EXPECT_LE(from.mean.lo, back * (1.0 + 1e-9) + 1e-10) << known.name;
    EXPECT_GE(from.mean.hi, back * (1.0 - 1e-9) - 1e-10) << known.name;
    ++pairs;
    tight += there.mean.hi - there.mean.lo <= 0.1 * known.factor ? 1 : 0;
  }
  EXPECT_GE(tight, pairs / 3);  // of intervals from 0 to 1 nothing would be learned
}

}  // namespace
}  // namespace enfilade
