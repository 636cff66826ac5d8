// Points of a polygon drawn as a point sees it, for light that varies over the polygon.
#pragma once

#include <span>

#include "base/geometry.hpp"
#include "base/random.hpp"

namespace enfilade {

struct KernelSampleConfig {
  /// A part whose squared distance is so many times its squared size is drawn from by area: the
  /// kernel varies by less than its mean there.
  double far2 = 4.0;
  /// Halvings of a triangle at most: each halves its area, so that the last is a thousandth as
  /// long.
  int most_halvings = 20;
};

struct KernelSample {
  Vec3 at{0.0};
  double weight = 0.0;  ///< 0: nothing of the polygon is seen
};

/// Draws a point of a planar convex polygon (front side counter-clockwise) with a density close to
/// that of point_kernel() from x with unit normal n: triangles and halves of them are chosen by
/// their form factors, until they are small for their distance. The expectation of weight * f(at)
/// is exactly the integral of the kernel times f over the polygon, whatever f is.
KernelSample sample_by_kernel(const Vec3& x, const Vec3& n, std::span<const Vec3> polygon,
                              Random& random, const KernelSampleConfig& config = {});

}  // namespace enfilade
