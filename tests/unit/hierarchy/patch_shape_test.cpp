#include "hierarchy/patch_shape.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace enfilade {
namespace {

const PatchOutline pentagon{{0, 0}, {3, 0.2}, {3.5, 1.5}, {1.7, 2.4}, {-0.3, 1.1}};

/// Integral of f over a polygon by a fine fan of midpoint triangles: an independent answer for
/// moments.
template <class F>
double integral(const PatchOutline& p, F f) {
  double sum = 0.0;
  const int n = 400;
  for (std::size_t i = 2; i < p.size(); ++i) {
    const Vec2 a = p[i - 1] - p[0], b = p[i] - p[0];
    const double area = 0.5 * (a.x * b.y - a.y * b.x) / (n * n);
    for (int j = 0; j < n; ++j) {
      for (int k = 0; k < n - j; ++k) {
        sum += area * f(p[0] + a * ((j + 1.0 / 3) / n) + b * ((k + 1.0 / 3) / n));
        if (k < n - j - 1)
          sum += area * f(p[0] + a * ((j + 2.0 / 3) / n) + b * ((k + 2.0 / 3) / n));
      }
    }
  }
  return sum;
}

TEST(PatchShape, MomentsMatchNumericalIntegrals) {
  const PatchShape s = PatchShape::from(pentagon);
  EXPECT_NEAR(s.area_m2, integral(pentagon, [](Vec2) { return 1.0; }), 1e-9);
  EXPECT_NEAR(s.centroid.x, integral(pentagon, [](Vec2 p) { return p.x; }) / s.area_m2, 1e-6);
  const Vec2 c = s.centroid;
  EXPECT_NEAR(s.cxx,
              integral(pentagon, [&](Vec2 p) { return (p.x - c.x) * (p.x - c.x); }) / s.area_m2,
              1e-5);
  EXPECT_NEAR(s.cxy,
              integral(pentagon, [&](Vec2 p) { return (p.x - c.x) * (p.y - c.y); }) / s.area_m2,
              1e-5);
}

TEST(PatchShape, QuadratureIsExactForQuadratics) {
  const PatchShape s = PatchShape::from(pentagon);
  const auto f = [](Vec2 p) {
    return 1.0 + p.x - 2.0 * p.y + p.x * p.x + 0.5 * p.x * p.y - p.y * p.y;
  };
  double mean = 0.0;
  for (const Vec2& p : s.quadrature()) mean += 0.25 * f(p);
  EXPECT_NEAR(mean, integral(pentagon, f) / s.area_m2, 1e-5);
}

TEST(PatchShape, TheLongAxisTurnsWithTheShape) {
  for (int degrees = -85; degrees <= 90; degrees += 5) {
    const double angle = degrees * std::numbers::pi / 180.0;
    const Vec2 along{std::cos(angle), std::sin(angle)}, across{-along.y, along.x};
    const PatchShape s = PatchShape::from({Vec2(7, 3), Vec2(7, 3) + 3.0 * along,
                                           Vec2(7, 3) + 3.0 * along + across, Vec2(7, 3) + across});
    EXPECT_NEAR(std::abs(glm::dot(s.long_axis(), along)), 1.0, 1e-12) << degrees;
    EXPECT_NEAR(glm::length(s.long_axis()), 1.0, 1e-12) << degrees;
  }
}

TEST(PatchShape, HalvesCoverTheWhole) {
  PatchShape s = PatchShape::from(pentagon);
  for (int depth = 0; depth < 12; ++depth) {
    const auto [low, high] = s.halves(s.cut({}));
    EXPECT_NEAR(low.area_m2 + high.area_m2, s.area_m2, 1e-12 * s.area_m2);
    EXPECT_GT(low.area_m2, 0.2 * s.area_m2);
    EXPECT_GT(high.area_m2, 0.2 * s.area_m2);
    s = high;
  }
}

TEST(PatchShape, IsCutAlongTheLineThatPartsItBest) {
  const PatchShape s = PatchShape::from({{0, 0}, {4, 0}, {4, 2}, {0, 2}});
  const MeshLine across{{1, 0}, {1, 2}}, short_one{{2, 0}, {2, 0.5}},
      at_the_rim{{0.25, 0}, {0.25, 2}};
  const auto at_x = [](const PatchCut& cut) { return cut.at / cut.axis.x; };
  const std::vector<MeshLine> all{short_one, at_the_rim, across};
  EXPECT_DOUBLE_EQ(at_x(s.cut(all)), 1.0);
  EXPECT_DOUBLE_EQ(at_x(s.cut(std::vector<MeshLine>{short_one, at_the_rim})), 2.0);
  // What is left for the part before it, is cut along the line at the rim.
  const auto [low, high] = s.halves(s.cut(all));
  const PatchShape& left = low.centroid.x < high.centroid.x ? low : high;
  EXPECT_DOUBLE_EQ(left.area_m2, 2.0);
  EXPECT_DOUBLE_EQ(at_x(left.cut(all)), 0.25);
}

}  // namespace
}  // namespace enfilade
