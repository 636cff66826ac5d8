// The floor of a room seen from above: where it is, how large, and how far its walls are.
#pragma once

#include <span>
#include <vector>

#include "geometry/polygon.hpp"

namespace enfilade {

/// A rectangle of the plan, turned by any angle.
struct PlanRectangle {
  Vec2 corner{0.0};
  Vec2 along{1.0, 0.0};                  ///< unit vector of the side `length_m`
  double length_m = 0.0, width_m = 0.0;  ///< the width is to the left of `along`
  Vec2 at(double u_m, double v_m) const {
    return corner + u_m * along + v_m * Vec2(-along.y, along.x);
  }
};

/// A region of the plan, of one part or several, with or without holes.
class RoomPlan {
 public:
  RoomPlan() = default;
  /// Of convex polygons, of which the x and y count.
  explicit RoomPlan(std::vector<Polygon> convex_parts);
  /// Of an outline that turns counter-clockwise; empty where it crosses itself.
  explicit RoomPlan(const std::vector<Vec2>& outline);

  bool empty() const { return parts_.empty(); }
  /// Area of the parts.
  double area_m2() const { return area_m2_; }
  bool contains(const Vec2& p) const;
  /// Returns the distance of p from the nearest edge of the region.
  double distance_to_edge(const Vec2& p) const;
  std::span<const Polygon> parts() const { return parts_; }
  /// Outlines and holes; the region lies to the right of each edge.
  const std::vector<std::vector<Vec2>>& rings() const { return rings_; }
  /// Returns the rectangle of least area around the region, its longer side as `length_m`; of
  /// equals that which lies along x. Has no area where the region is empty.
  PlanRectangle rectangle() const;
  /// Returns about `count` points spread evenly over the region, at least one where it has an area.
  std::vector<Vec2> spread(std::size_t count) const;
  /// Returns the point that is farthest from the edge, to 1%.
  Vec2 middle() const;

 private:
  std::vector<Polygon> parts_;
  std::vector<std::vector<Vec2>> rings_;
  double area_m2_ = 0.0;
};

}  // namespace enfilade
