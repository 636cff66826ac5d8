// The shape of a patch: its outline, its area moments, and how it is cut in two.
#pragma once

#include <array>
#include <span>
#include <utility>

#include <boost/container/small_vector.hpp>

#include "base/geometry.hpp"

namespace enfilade {

/// A segment along which another polygon touches or crosses a polygon, in that polygon's frame
/// (metres). Light is discontinuous or bends there (discontinuity meshing).
struct MeshLine {
  Vec2 a{0.0}, b{0.0};
};

/// How a patch is cut in two: the first half lies where dot(axis, p) < at.
struct PatchCut {
  Vec2 axis{1.0, 0.0};
  double at = 0.0;
};

/// A patch's outline; most are triangles and quads, which need no heap memory.
using PatchOutline = boost::container::small_vector<Vec2, 4>;

/// A convex patch in the frame of its polygon, with its area moments up to the second order.
struct PatchShape {
  PatchOutline vertices;  ///< counter-clockwise, metres
  Vec2 centroid{0.0};
  double area_m2 = 0.0;
  double cxx = 0.0, cxy = 0.0, cyy = 0.0;  ///< covariance of the area, m2

  /// Makes the shape with these vertices. Where their area is not positive the moments are zero.
  static PatchShape from(const PatchOutline& vertices);
  /// Returns the unit direction of the greatest extent (first principal axis of the covariance);
  /// the frame's x axis where no direction is longer than another.
  Vec2 long_axis() const;
  /// Returns the cut of the patch: along the mesh line that runs through most of the patch and
  /// leaves neither half a sliver; without such a line, through the centroid across the long axis.
  /// Depends on the shape and the lines alone, so every rank makes the same halves.
  PatchCut cut(std::span<const MeshLine> lines) const;
  std::pair<PatchShape, PatchShape> halves(const PatchCut& cut) const;
  /// Returns four points at centroid +- s1 e1 +- s2 e2 (e principal axes, s standard deviations),
  /// each with a quarter of the area: exact for quadratics on any polygon, and on a rectangle the 2
  /// x 2 Gauss rule.
  std::array<Vec2, 4> quadrature() const;
  /// Returns a point in quarter 0 .. 3 of the area for r1 and r2 in [0, 1): uniformly distributed
  /// where the patch is a rectangle. On another shape the quadrature point replaces each point that
  /// lies in the rectangle of the same moments but outside the patch.
  Vec2 point_in_quarter(int quarter, double r1, double r2) const;
  /// Returns the standard deviations of the area along the principal axes: (s1, s2), metres.
  Vec2 deviations() const;
};

}  // namespace enfilade
