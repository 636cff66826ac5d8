// Whether a group of polygons, or a polygon far off, can be seen at all, and how much of it at
// most.
#pragma once

#include <span>
#include <vector>

#include "bounds/factors/flat_shape.hpp"
#include "raycast/ray_scene.hpp"

namespace enfilade {

/// Proofs that walls hide things from each other. Rays only propose the walls.
class GroupSight {
 public:
  /// `panes`: 1 for each polygon that hides nothing; empty: there are none.
  GroupSight(std::span<const Polygon> polygons, double tolerance_m,
             std::span<const char> panes = {});

  /// True where it is certain that no segment from the receiver to the hull of `corners` is free:
  /// one polygon, or polygons of one plane together, meet all of them. `skip`: the polygon that the
  /// receiver belongs to, and the one that the corners do (or none).
  bool hidden(const FlatShape& receiver, std::uint32_t receiver_polygon,
              const std::vector<Vec3>& corners, std::uint32_t target_polygon) const;

  /// Returns an upper bound of the form factor from any point of the receiver to everything inside
  /// the box: 0 where it lies behind the receiver, else that of the ball around it (at most
  /// (radius / distance)^2, of a ball that faces the receiver).
  static double most_factor(const FlatShape& receiver, const Box& box);

 private:
  std::span<const Polygon> polygons_;
  double tolerance_m_;
  RayScene rays_;
  std::vector<std::uint32_t> plane_of_;                  ///< number of each polygon's plane
  std::vector<std::vector<std::uint32_t>> polygons_of_;  ///< of each plane
};

}  // namespace enfilade
