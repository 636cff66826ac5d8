// Cuts of convex polygons and segments by planes and lines.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "geometry/polygon.hpp"

namespace enfilade {

/// The point of the line through `a` and `b` where an affine function with the values `at_a` and
/// `at_b` there is zero. Computed from `a`: with the ends swapped it may differ by rounding.
template <class Point>
Point zero_crossing(const Point& a, double at_a, const Point& b, double at_b) {
  return a + (b - a) * (at_a / (at_a - at_b));
}

/// Walks once round a convex polygon that is cut where the affine function `side` is zero
/// (Sutherland and Hodgman 1974): calls `on_corner(p, is_below)` for each corner, below where side
/// < 0, and before it `on_crossing(p)` where the edge that leads to it passes from one side to the
/// other. Corners are points of the plane or of space. A corner belongs to one side only, without
/// tolerance; `split` has one.
/// The corners are at(0) ... at(count - 1).
template <class At, class Side, class OnCorner, class OnCrossing>
void walk_cut(std::size_t count, const At& at, const Side& side, OnCorner&& on_corner,
              OnCrossing&& on_crossing) {
  auto a = at(count - 1);
  double side_a = side(a);
  for (std::size_t i = 0; i < count; ++i) {
    const auto b = at(i);
    const double side_b = side(b);
    const bool is_below = side_b < 0.0;
    if ((side_a < 0.0) != is_below) on_crossing(zero_crossing(a, side_a, b, side_b));
    on_corner(b, is_below);
    a = b;
    side_a = side_b;
  }
}
template <class Corners, class Side, class OnCorner, class OnCrossing>
void walk_cut(const Corners& corners, const Side& side, OnCorner&& on_corner,
              OnCrossing&& on_crossing) {
  walk_cut(
      corners.size(), [&corners](std::size_t i) { return corners[i]; }, side, on_corner,
      on_crossing);
}

/// Cuts by a plane: first = the part in front, second = the part behind; either may be empty.
/// Vertices within `tolerance` metres of the plane count as on it, so no sliver thinner than that
/// is made. A polygon that lies in the plane counts as in front. Two polygons that share an edge
/// get the very same point where the plane crosses it.
std::pair<Polygon, Polygon> split(const Polygon& polygon, const Plane& plane, double tolerance);

/// Keeps what lies behind the plane (or within `tolerance` of it), in place; the same points as
/// `split` makes, but a polygon that lies in the plane is kept.
void clip_behind(Polygon& polygon, const Plane& plane, double tolerance);
/// Keeps what lies in front of the plane (or within `tolerance` of it), in place. Crossings are
/// computed from their ends behind the plane, where `split` takes those in front: they may differ
/// by rounding.
void clip_front(Polygon& polygon, const Plane& plane, double tolerance);

/// Keeps the part of the segment in front of the plane. Returns false, with the segment unchanged,
/// where no end lies more than `tolerance` metres in front.
bool clip_front(Segment& segment, const Plane& plane, double tolerance);

/// a minus b, both convex and coplanar within tolerance: at most |b| convex pieces, none for full
/// cover, {a} itself where they do not overlap by more than `tolerance`. The two may face opposite
/// ways.
std::vector<Polygon> subtract_coplanar(const Polygon& a, const Polygon& b, double tolerance);

/// Returns the common part of two convex coplanar polygons, facing as `a` does; empty where there
/// is none.
Polygon intersect_coplanar(const Polygon& a, const Polygon& b, double tolerance);

}  // namespace enfilade
