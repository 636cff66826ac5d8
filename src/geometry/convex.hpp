// Convex regions of space and convex polygons: the small geometry that the binary space partition
// is made of.
#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "geometry/polygon.hpp"

namespace enfilade {

/// A face of a convex region; the plane's front is outside the region.
struct Facet {
  Plane plane;
  Polygon polygon;
};

/// A bounded convex polyhedron.
struct Region {
  std::vector<Facet> facets;
};

/// An orthonormal frame.
using Frame = std::array<Vec3, 3>;

/// The smallest box along `axes` that holds all points, `margin` larger on every side.
Region box_region(std::span<const Vec3> points, const Frame& axes, double margin);

/// The plane's polygon inside the region, counter-clockwise seen from the plane's front; may be
/// empty.
Polygon cross_section(const Region& region, const Plane& plane);

/// The parts in front of and behind the plane; `section` is the region's cross-section there.
std::pair<Region, Region> split_region(const Region& region, const Plane& plane,
                                       const Polygon& section);

/// The largest facet of `part` that lies in a side of `whole`; none where it touches none.
const Facet* largest_on_border(const Region& part, const Region& whole);

double volume_m3(const Region& region);
Box bounds(const Region& region);

/// Keeps what lies behind the plane (or within `tolerance` of it), in place.
void clip_behind(Polygon& polygon, const Plane& plane, double tolerance);
/// The same, in front.
void clip_front(Polygon& polygon, const Plane& plane, double tolerance);

/// Convex hull of points of a plane with this unit normal, counter-clockwise seen from its front.
/// Points on the hull's edges are left out.
Polygon convex_hull(std::vector<Vec3> points, const Vec3& n);

/// Largest distance between two vertices.
double diameter(const Polygon& polygon);

}  // namespace enfilade
