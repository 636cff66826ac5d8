// The occluders in each plane: a wall is many polygons, but hides what lies behind it as one.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "geometry/box_tree.hpp"
#include "geometry/polygon.hpp"

namespace enfilade {

/// Polygons by the plane that they lie in, exactly: to rounding, not to a tolerance, because a line
/// may pass between two polygons that are put out of one plane by a millimetre.
class OccluderPlanes {
 public:
  /// `left_out`: 1 for each polygon that hides nothing; empty: there are none.
  explicit OccluderPlanes(std::span<const Polygon> polygons, std::span<const char> left_out = {});

  std::size_t size() const { return planes_.size(); }
  const Plane& plane(std::uint32_t k) const { return planes_[k].plane; }
  /// For a polygon that is not flat, the plane of its first triangle.
  std::uint32_t plane_of_polygon(std::uint32_t polygon) const { return plane_of_polygon_[polygon]; }

  bool is_flat(std::uint32_t polygon) const { return flat_[polygon]; }

  /// Returns the parts of `openings` (convex, in plane k) that no polygon covers; polygons in
  /// `skip` (sorted) do not cover. Stops at more than `max_pieces` parts and returns them, larger
  /// than they are.
  std::vector<Polygon> uncovered(std::uint32_t k, std::vector<Polygon> openings,
                                 std::span<const std::uint32_t> skip, std::size_t max_pieces) const;

 private:
  struct Part {
    Polygon polygon;
    Box box;
    std::uint32_t of = 0;  ///< the polygon that it is, or is a triangle of
  };
  struct Occluders {
    Plane plane;
    std::vector<Part> parts;
    std::unique_ptr<BoxTree> tree;  ///< over the parts, where there are many
  };

  std::vector<Occluders> planes_;
  std::vector<std::uint32_t> plane_of_polygon_;
  std::vector<bool> flat_;  ///< by polygon: all of it lies in its plane
  double sliver_m_ = 0.0;
};

}  // namespace enfilade
