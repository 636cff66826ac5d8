// Which polygons see lit fronts alone, wherever they look: a proof.
#pragma once

#include <span>
#include <vector>

#include "geometry/polygon.hpp"

namespace enfilade {

/// What the scene's polygons enclose.
struct ClosedFronts {
  /// Per polygon, 1: every line from its front ends on the front of another, so that its form
  /// factors sum to 1.
  std::vector<char> polygons;
  /// Per point asked for: every line from it ends on a front.
  std::vector<char> points;
};

/// The polygons' borders cancel as chains of edges (with their directions, T-vertices allowed), and
/// no polygon passes through another: then each side of each polygon lies in one region of space
/// with one winding number, told by the sum of the signed solid angles. A line from a region with
/// the number 1 cannot leave it but through a front, if no polygon has its back to such a region.
/// Where one of this fails, or there are more than `most` polygons, nothing is closed. What is
/// within `tolerance_m` touches.
ClosedFronts closed_fronts(std::span<const Polygon> polygons, std::span<const Vec3> points,
                           double tolerance_m, std::size_t most = 4000);

}  // namespace enfilade
