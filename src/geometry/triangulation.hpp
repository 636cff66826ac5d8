// Triangles of a ring in the plane, by GEOS.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/geometry.hpp"

namespace enfilade {

struct Triangulation {
  bool simple = true;  ///< false: the ring crosses itself, and nothing else here is filled
  /// The points of the ring in its order, then those added where the ring touches itself.
  std::vector<Vec2> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise, constrained Delaunay
};

/// Triangulates a counter-clockwise ring. A ring that only touches itself (a hole joined to the
/// outline by a cut) is fine; one whose loops enclose more than `area_tolerance` beyond its signed
/// area is not simple.
Triangulation triangulate(const std::vector<Vec2>& ring, double area_tolerance);

}  // namespace enfilade
