// Shafts: which polygons reach into the space between two others (Haines and Wallace 1991).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/polygon.hpp"

namespace enfilade {

/// The convex hull of two convex polygons, as half-spaces; inside is where every signed distance <=
/// 0. Only what lies in front of both polygons counts, since light between their front sides stays
/// there.
struct Shaft {
  Box box;  ///< of the hull
  std::vector<Plane> planes;
};
Shaft shaft_between(const Polygon& a, const Polygon& b, double tolerance_m);

/// A bounding-volume tree over polygons that answers shaft queries.
class ShaftTree {
 public:
  explicit ShaftTree(std::vector<Polygon> polygons);

  /// Does a polygon other than skip_a, skip_b reach more than tolerance_m into the shaft?
  bool blocked(const Shaft& shaft, double tolerance_m, std::uint32_t skip_a,
               std::uint32_t skip_b) const;
  /// Appends the polygons other than skip_a, skip_b that reach more than tolerance_m into the
  /// shaft, until there are more than `most`; in the same order for the same shaft.
  void find(const Shaft& shaft, double tolerance_m, std::uint32_t skip_a, std::uint32_t skip_b,
            std::size_t most, std::vector<std::uint32_t>& found) const;
  /// Appends those of the polygons `among` that `find` would append, in the order of `among`: for a
  /// shaft inside one that has been searched.
  void find_among(std::span<const std::uint32_t> among, const Shaft& shaft, double tolerance_m,
                  std::uint32_t skip_a, std::uint32_t skip_b,
                  std::vector<std::uint32_t>& found) const;
  /// Returns the polygons that pass within reach_m of p, in ascending order.
  std::vector<std::uint32_t> touching(const Vec3& p, double reach_m) const;
  const Polygon& polygon(std::uint32_t k) const { return polygons_[k]; }

 private:
  struct Node {
    Box box;
    std::uint32_t begin = 0, end = 0;  // polygons, at a leaf
    std::int32_t left = -1, right = -1;
  };
  std::int32_t build(std::uint32_t begin, std::uint32_t end);

  std::vector<Polygon> polygons_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace enfilade
