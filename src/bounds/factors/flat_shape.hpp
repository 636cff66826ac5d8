// A planar convex polygon with what bounds of form factors ask of it.
#pragma once

#include <vector>

#include "geometry/polygon.hpp"

namespace enfilade {

/// A planar convex polygon, its plane, its area centroid and how far its corners lie from that.
struct FlatShape {
  FlatShape() = default;
  /// Of a polygon in the plane `plane` (unit normal towards its front).
  FlatShape(Polygon corners, const Plane& plane);

  Polygon polygon;
  Plane plane;
  Vec3 center{0.0};
  double area_m2 = 0.0;
  double radius_m = 0.0;  ///< largest distance of a corner from `center`
};

/// A place on a polygon and its share of an integral over the polygon's area, m2.
struct QuadraturePoint {
  Vec3 p{0.0};
  double weight_m2 = 0.0;
};

/// Appends the points of a rule that integrates polynomials up to degree 3 (`fine` false) or 7
/// (`fine` true) over the polygon exactly: products of Gauss-Legendre rules, on a parallelogram as
/// they are, else on the triangles of a fan.
void add_quadrature(const FlatShape& shape, bool fine, std::vector<QuadraturePoint>& out);

/// Returns the standard deviation of the points' places along the line in the plane on which it is
/// largest, m.
double largest_deviation_m(const FlatShape& shape);

/// Returns the two halves of a shape, cut across its longest extent: a parallelogram's are
/// parallelograms, a triangle's are triangles.
std::pair<FlatShape, FlatShape> halves(const FlatShape& shape);

}  // namespace enfilade
