#include "bounds/iteration/direct_bounds.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/sampling.hpp"
#include "unit/bounds/random_polygon.hpp"

namespace enfilade {
namespace {

TEST(DirectBounds, HoldRandomReceivers) {
  Random random(13);
  for (int trial = 0; trial < 500; ++trial) {
    std::vector<Polygon> all{random_polygon(random, 1.0), random_polygon(random, 0.6)};
    const FlatShape r = shape(all[0]);
    const Vec3 light = random_place(random, 2.0);
    const double height = r.plane.signed_distance(light);
    if (r.area_m2 < 1e-3 || std::abs(height) < 0.02) continue;
    const LightRange e = direct_bounds(light, {r, 0}, PairFactors(all));
    const Plane wall = plane_of(all[1]);
    double sum = 0.0, squares = 0.0;
    constexpr int strata = 40;
    for (int i = 0; i < strata * strata; ++i) {
      const Vec3 x = uniform_point(r.polygon, (i / strata + random.uniform()) / strata,
                                   (i % strata + random.uniform()) / strata);
      const double a = wall.signed_distance(x), b = wall.signed_distance(light);
      const bool hidden = a * b < 0.0 && contains(all[1], wall.n, x + (light - x) * (a / (a - b)));
      const double d = glm::length(light - x);
      const double value = hidden || height < 0.0 ? 0.0 : height / (d * d * d);
      ASSERT_GE(value, e.at_points.lo - 1e-9) << trial;
      ASSERT_LE(value, e.at_points.hi + 1e-9) << trial;
      sum += value;
      squares += value * value;
    }
    const double n = strata * strata, mean = sum / n;
    const double noise = std::sqrt(std::max(0.0, squares / n - mean * mean) / n);
    ASSERT_GE(mean, e.mean.lo - noise - 1e-9) << trial;
    ASSERT_LE(mean, e.mean.hi + noise + 1e-9) << trial;
  }
}

}  // namespace
}  // namespace enfilade
