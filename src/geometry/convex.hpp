// Convex polyhedra (regions) and convex hulls: the geometry of the binary space partition.
#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "geometry/clip.hpp"
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

/// Returns the bounds of the points' coordinates along `axes`.
Box bounds_along(std::span<const Vec3> points, const Frame& axes);

/// Returns the smallest box along `axes` that holds all points, `margin` larger on every side.
Region box_region(std::span<const Vec3> points, const Frame& axes, double margin);

/// Returns the part of the plane inside the region, counter-clockwise seen from the plane's front;
/// empty where the plane does not cross the region.
Polygon cross_section(const Region& region, const Plane& plane);

/// Returns the parts in front of and behind the plane; `section` is the region's cross-section
/// there.
std::pair<Region, Region> split_region(const Region& region, const Plane& plane,
                                       const Polygon& section);

/// Returns the largest facet of `part` that lies in a facet of `whole`; null where no facet of it
/// does.
const Facet* largest_on_border(const Region& part, const Region& whole);

/// Returns the range of the corners' distances from the plane.
DistanceRange distances(const Region& region, const Plane& plane);

double volume_m3(const Region& region);
Box bounds(const Region& region);

/// Returns the convex hull of points of a plane with this unit normal, counter-clockwise seen from
/// its front. Points on the hull's edges are left out.
Polygon convex_hull(std::vector<Vec3> points, const Vec3& n);

/// Returns the largest distance between two vertices.
double diameter(const Polygon& polygon);

}  // namespace enfilade
