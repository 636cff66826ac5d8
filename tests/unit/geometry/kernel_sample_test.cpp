// Points drawn by the kernel against closed forms and plain quadrature.
#include "geometry/kernel_sample.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "geometry/form_factor.hpp"
#include "geometry/polygon.hpp"
#include "unit/statistics.hpp"

namespace enfilade {
namespace {

using Value = std::function<double(const Vec3&)>;

/// The integral of the kernel times f over a rectangle of the plane z = 1 (front down), by the
/// midpoint rule.
double quadrature(const Vec3& x, const Vec3& n, const Vec2& lo, const Vec2& hi, const Value& f) {
  constexpr int side = 2000;
  double sum = 0.0;
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      const Vec3 y(lo.x + (i + 0.5) / side * (hi.x - lo.x), lo.y + (j + 0.5) / side * (hi.y - lo.y),
                   1.0);
      sum += point_kernel(x, n, y, {0, 0, -1}) * f(y);
    }
  }
  return sum * (hi.x - lo.x) * (hi.y - lo.y) / (side * side);
}

Polygon rectangle(const Vec2& lo, const Vec2& hi) {
  return {{lo.x, lo.y, 1.0}, {lo.x, hi.y, 1.0}, {hi.x, hi.y, 1.0}, {hi.x, lo.y, 1.0}};
}

testing::Samples drawn(const Vec3& x, const Vec3& n, const Polygon& polygon, const Value& f) {
  Random random(7);
  testing::Samples samples;
  for (int i = 0; i < 20000; ++i) {
    const KernelSample sample = sample_by_kernel(x, n, polygon, random);
    samples.add(sample.weight > 0.0 ? sample.weight * f(sample.at) : 0.0);
  }
  return samples;
}

/// From far away, from close before it, and from a place whose horizon cuts it.
struct View {
  Vec3 x, n;
};
const View views[] = {{{0.3, 0.4, -9.0}, {0, 0, 1}},
                      {{0.2, 0.1, 0.95}, {0, 0, 1}},
                      {{-0.3, 0.5, 0.9}, {0.8, 0, 0.6}},
                      {{0.5, -0.1, 0.2}, {0, 1, 0}},
                      {{2.0, 0.5, 0.7}, {-0.28, 0, 0.96}}};
const Vec2 lo(-1.0, -0.5), hi(3.0, 1.5);

TEST(KernelSample, SumsToTheFormFactor) {
  for (const View& view : views) {
    const Polygon polygon = rectangle(lo, hi);
    const double factor = point_to_polygon(view.x, view.n, polygon);
    const testing::Samples samples =
        drawn(view.x, view.n, polygon, [](const Vec3&) { return 1.0; });
    EXPECT_TRUE(testing::has_mean(samples, factor, 5, 1e-9 * factor));
    // The density is close to the kernel: half of the mean, where by area it may be many times.
    EXPECT_LT(samples.variance(), 0.25 * factor * factor);
  }
}

/// What varies over the polygon is weighted as the point sees it.
TEST(KernelSample, WeighsWhatVariesAsThePointSeesIt) {
  const Value steep = [](const Vec3& y) { return std::exp(-3.0 * std::abs(y.x - 1.5)); };
  for (const View& view : views) {
    const double want = quadrature(view.x, view.n, lo, hi, steep);
    EXPECT_TRUE(
        testing::has_mean(drawn(view.x, view.n, rectangle(lo, hi), steep), want, 5, 1e-3 * want));
  }
}

TEST(KernelSample, DrawsNothingOfWhatIsNotSeen) {
  Random random(1);
  const Polygon polygon = rectangle(lo, hi);
  for (const View& view : {View{{0, 0, 2.0}, {0, 0, 1}}, View{{0, 0, 0.9}, {0, 0, -1}}})
    EXPECT_EQ(sample_by_kernel(view.x, view.n, polygon, random).weight, 0.0);
}

}  // namespace
}  // namespace enfilade
