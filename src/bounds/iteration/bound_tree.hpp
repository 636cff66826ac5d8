// The tree of what shoots light: groups of polygons, polygons, and the patches that they are cut
// into. Its leaves below the polygons are what receives.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bounds/factors/flat_shape.hpp"

namespace enfilade {

constexpr std::uint32_t no_index = 0xFFFFFFFFu;

/// A group (no polygon), a polygon, or a patch of one.
struct BoundNode {
  Box box;
  std::uint32_t parent = no_index;
  std::uint32_t first_child = no_index;  ///< the second one follows it
  std::uint32_t polygon = no_index;      ///< index of the polygon; none for a group
  FlatShape shape;                       ///< of a polygon or patch
  double area_m2 = 0.0;
  bool is_leaf() const { return first_child == no_index; }
  bool is_group() const { return polygon == no_index; }
  double size_m() const { return is_group() ? box.diagonal() : 2.0 * shape.radius_m; }
};

/// A binary tree whose node 0 is the root. Children come after their parents.
class BoundTree {
 public:
  explicit BoundTree(std::span<const Polygon> polygons);

  std::size_t size() const { return nodes_.size(); }
  const BoundNode& operator[](std::size_t k) const { return nodes_[k]; }
  /// The node of each polygon.
  std::span<const std::uint32_t> polygon_nodes() const { return polygon_nodes_; }
  /// Cuts a leaf in two; returns the first new node.
  std::uint32_t split(std::uint32_t leaf);

 private:
  void build(std::span<const Polygon> polygons, std::uint32_t node, std::span<std::uint32_t> among);

  std::vector<BoundNode> nodes_;
  std::vector<std::uint32_t> polygon_nodes_;
};

}  // namespace enfilade
