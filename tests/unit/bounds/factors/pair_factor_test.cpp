// Bounds of form factors against the factors themselves, at random points of random pairs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/random.hpp"
#include "bounds/factors/pair_factor.hpp"
#include "geometry/form_factor.hpp"
#include "geometry/sampling.hpp"
#include "geometry/visible_parts.hpp"
#include "unit/bounds/random_polygon.hpp"

namespace enfilade {
namespace {

/// The factor from a point, past the occluders, in closed form.
double factor_at(const Vec3& x, const Vec3& n, const Polygon& shooter,
                 std::span<const Polygon> occluders) {
  if (plane_of(shooter).signed_distance(x) <= 0.0) return 0.0;
  VisibleParts parts;
  parts.begin(x, shooter, 1e-12);
  for (const Polygon& occluder : occluders) parts.hide(occluder, 10000);
  return parts.factor(n);
}

/// One pair: the factor at many points, and its mean as their sum, must lie within the bounds.
void expect_within(const PairFactor& f, const FlatShape& receiver, const Polygon& shooter,
                   std::span<const Polygon> occluders, Random& random, int trial) {
  double sum = 0.0, squares = 0.0;
  constexpr int strata = 24;
  for (int i = 0; i < strata * strata; ++i) {
    const double r1 = (i / strata + random.uniform()) / strata,
                 r2 = (i % strata + random.uniform()) / strata;
    const Vec3 x = uniform_point(receiver.polygon, r1, r2);
    const double exact = factor_at(x, receiver.plane.n, shooter, occluders);
    const double affine = f.at_points.center + glm::dot(f.at_points.gradient, x - receiver.center);
    ASSERT_LE(std::abs(exact - affine), f.at_points.remainder + 1e-7) << "pair " << trial;
    sum += exact;
    squares += exact * exact;
  }
  const double n = strata * strata, mean = sum / n;
  // Stratified points are closer than this, the error of as many independent ones.
  const double noise = std::sqrt(std::max(0.0, squares / n - mean * mean) / n);
  ASSERT_GE(mean, f.mean.lo - noise - 2e-6) << "pair " << trial;
  ASSERT_LE(mean, f.mean.hi + noise + 2e-6) << "pair " << trial;
}

TEST(PairFactors, HoldOpenRandomPairs) {
  Random random(11);
  int seen = 0, tight = 0;
  for (int trial = 0; trial < 1500; ++trial) {
    const double size = trial % 3 == 0 ? 0.4 : 1.5;
    const std::vector<Polygon> pair{random_polygon(random, size), random_polygon(random, size)};
    const FlatShape r = shape(pair[0]), s = shape(pair[1]);
    if (r.area_m2 < 1e-3 || s.area_m2 < 1e-3) continue;
    const PairFactor f = PairFactors(pair)({r, 0}, {s, 1}, false);
    expect_within(f, r, pair[1], {}, random, trial);
    if (::testing::Test::HasFatalFailure()) return;
    seen += f.mean.hi > 0.0;
    tight += f.mean.hi > 0.0 && f.mean.width() < 0.05 * f.mean.hi;
  }
  EXPECT_GT(seen, 400);
  EXPECT_GT(tight, seen / 2);
}

TEST(PairFactors, HoldRandomPairsBehindOccluders) {
  Random random(12);
  int occluded = 0, narrowed = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    std::vector<Polygon> all{random_polygon(random, 0.8), random_polygon(random, 0.8)};
    for (const auto& [a, b] : {std::pair{0, 1}, std::pair{1, 0}}) {  // they face each other
      if (plane_of(all[a]).signed_distance(centroid(all[b])) < 0.0)
        std::reverse(all[a].begin(), all[a].end());
    }
    const auto count = 1 + random.below(4);
    for (std::uint64_t i = 0; i < count; ++i) all.push_back(random_polygon(random, 1.0));
    const FlatShape r = shape(all[0]), s = shape(all[1]);
    if (r.area_m2 < 1e-3 || s.area_m2 < 1e-3) continue;
    const PairFactor f = PairFactors(all)({r, 0}, {s, 1}, false);
    expect_within(f, r, all[1], std::span(all).subspan(2), random, trial);
    if (::testing::Test::HasFatalFailure()) return;
    const PairFactor alone = PairFactors({all[0], all[1]})({r, 0}, {s, 1}, false);
    occluded += !f.open && !alone.none();
    narrowed += !f.open && f.mean.hi < 0.9 * alone.mean.hi;
  }
  EXPECT_GT(occluded, 100);
  EXPECT_GT(narrowed, 30);
}

TEST(PairFactors, HoldPairsThatShareAnEdge) {
  // Unit squares at right angles: F = 0.2000437761 (Howell, configuration C-14).
  const std::vector<Polygon> pair{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                                  {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}}};
  const PairFactor f = PairFactors(pair)({shape(pair[0]), 0}, {shape(pair[1]), 1}, false);
  EXPECT_LE(f.mean.lo, 0.2000437761);
  EXPECT_GE(f.mean.hi, 0.2000437761);
  EXPECT_GT(f.mean.lo, 0.12);
}

}  // namespace
}  // namespace enfilade
