// Which parts of a polygon are seen from all points of another, from none, and perhaps from some.
#pragma once

#include <cstdint>
#include <vector>

#include "bounds/factors/flat_shape.hpp"
#include "geometry/shaft_tree.hpp"

namespace enfilade {

/// What a viewer sees of a target. What is in neither list is hidden from every point of the
/// viewer.
struct SplitSight {
  std::vector<Polygon> seen;    ///< nothing stands between any point of these and the viewer
  std::vector<Polygon> unsure;  ///< something may
};

/// Cuts the target by the occluders' shadows: outside the penumbra of an occluder (half spaces
/// through its edges that touch the viewer) it hides nothing; inside the shadows that all of the
/// viewer's corners cast (the umbra of a convex viewer) it hides all. An occluder that crosses the
/// viewer's plane may hide anything. Where more than `most_parts` parts would be left, the target
/// is unsure as a whole. The last `panes` of the occluders are panes: what is seen through one may
/// be dimmed, and is unsure; none hides anything.
SplitSight split_sight(const FlatShape& viewer, const Polygon& target, const Plane& target_plane,
                       const std::vector<const Polygon*>& occluders, double tolerance_m,
                       std::size_t panes = 0, std::size_t most_parts = 48);

/// True where it is certain that `wall` (convex) meets every segment between a point of the convex
/// hull of `a` and one of `b`: all of these cross its plane within the hull of the crossings
/// between corners.
bool wall_hides(const Polygon& wall, const std::vector<Vec3>& a, const std::vector<Vec3>& b);

/// The same for several walls of one plane together: they cover the hull of the crossings.
bool walls_hide(const Plane& plane, const std::vector<const Polygon*>& walls,
                const std::vector<Vec3>& a, const std::vector<Vec3>& b, double tolerance_m);

}  // namespace enfilade
