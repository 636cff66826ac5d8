// Closed forms and exact visibility against the public set of form factors.
#include <gtest/gtest.h>

#include "base/random.hpp"
#include "geometry/form_factor.hpp"
#include "geometry/sampling.hpp"
#include "geometry/visible_parts.hpp"
#include "unit/known_factors.hpp"

namespace enfilade {
namespace {

constexpr std::size_t all_parts = 1u << 20;

double visible_factor(const Vec3& x, const Vec3& n, const testing::KnownFactor& known,
                      VisibleParts& parts) {
  parts.begin(x, known.shooter, 1e-12);
  for (const Polygon& occluder : known.occluders) EXPECT_TRUE(parts.hide(occluder, all_parts));
  return parts.factor(n);
}

TEST(KnownFactors, AreManyAndOfAllKinds) {
  int points = 0, pairs = 0, obstructed = 0, none = 0;
  for (const testing::KnownFactor& known : testing::known_factors()) {
    ++(known.from_point() ? points : pairs);
    obstructed += known.occluders.empty() ? 0 : 1;
    none += known.factor == 0.0 ? 1 : 0;
  }
  EXPECT_GE(points, 30);
  EXPECT_GE(pairs, 50);
  EXPECT_GE(obstructed, 40);
  EXPECT_GE(none, 5);
}

TEST(PointToPolygon, IsThatOfTheKnownOpenPairs) {
  int count = 0;
  for (const testing::KnownFactor& known : testing::known_factors()) {
    if (!known.from_point() || !known.occluders.empty()) continue;
    ++count;
    EXPECT_NEAR(point_to_polygon(known.x, known.n, known.shooter), known.factor, 2e-10)
        << known.name;
  }
  EXPECT_GE(count, 10);
}

TEST(VisibleParts, LeaveTheKnownFactorsOfPoints) {
  VisibleParts parts;
  for (const testing::KnownFactor& known : testing::known_factors()) {
    if (!known.from_point()) continue;
    EXPECT_NEAR(visible_factor(known.x, known.n, known, parts), known.factor, 1e-9) << known.name;
  }
}

/// The mean over stratified points of the receiver: within 5 standard errors of as many independent
/// ones, which are farther off than these.
TEST(VisibleParts, HaveTheKnownMeansOverPolygons) {
  VisibleParts parts;
  Random random(3);
  for (const testing::KnownFactor& known : testing::known_factors()) {
    if (known.from_point()) continue;
    const Vec3 n = normal(known.receiver);
    const int strata = known.occluders.size() > 8 ? 16 : 40;
    double sum = 0.0, square = 0.0;
    for (int i = 0; i < strata * strata; ++i) {
      const double r1 = (i / strata + random.uniform()) / strata,
                   r2 = (i % strata + random.uniform()) / strata;
      const double f = visible_factor(uniform_point(known.receiver, r1, r2), n, known, parts);
      sum += f;
      square += f * f;
    }
    const double count = strata * strata, mean = sum / count;
    const double deviation = std::sqrt(std::max(0.0, square / count - mean * mean) / count);
    EXPECT_NEAR(mean, known.factor, 5.0 * deviation + 1e-9) << known.name;
  }
}

}  // namespace
}  // namespace enfilade
