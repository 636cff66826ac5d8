// The hierarchy above the clusters: parts of the building, cells, groups of clusters. A node of it
// shoots as one towards receivers far away (hierarchical radiosity with clustering: Smits, Arvo and
// Greenberg 1994; a building's parts as in Walter et al. 2005, "Lightcuts").
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/geometry.hpp"
#include "base/ids.hpp"
#include "clusters/cluster.hpp"

namespace enfilade {

/// The directions of a node's light: +x, -x, +y, -y, +z, -z.
constexpr std::size_t directions = 6;

/// How much of each of the six directions lies in unit vector w; a polygon of normal n turns the
/// sum of axis_shares(n) * axis_shares(w) of its area to w: exact where n is along an axis.
/// With w = 0: a half of each, for what is sent to all sides.
std::array<double, directions> axis_shares(const Vec3& w);

/// A binary tree: cells are parted by the widest extent of their middles, then the clusters of one
/// cell; the leaves are the clusters. Geometry alone, the same on every rank.
class BuildingTree {
 public:
  static constexpr std::uint32_t root = 0;

  struct Node {
    Box bounds;
    std::uint32_t left = 0, right = 0;           ///< children; 0 at a leaf
    ClusterId cluster;                           ///< of a leaf
    std::uint32_t begin = 0, end = 0;            ///< its clusters, a range of clusters()
    std::uint32_t first_cell = 0, end_cell = 0;  ///< its cells, a range of cells()
    std::array<double, directions>
        facing_m2{};  ///< area of its polygons, as axis_shares of normals
    std::uint32_t polygons = 0;
    bool leaf() const { return left == 0; }
  };

  explicit BuildingTree(std::span<const Cluster> clusters);

  std::span<const Node> nodes() const { return nodes_; }
  const Node& node(std::uint32_t i) const { return nodes_[i]; }
  /// Returns the clusters in the tree's order.
  std::span<const ClusterId> clusters() const { return clusters_; }
  /// Returns the cells with clusters, in the tree's order.
  std::span<const CellId> cells() const { return cells_; }
  std::uint32_t leaf_of(ClusterId cluster) const { return leaf_of_[cluster.index()]; }
  /// Returns the place of a cell in cells(); none (0xFFFFFFFF) for a cell without clusters.
  std::uint32_t place_of(CellId cell) const {
    return cell.index() < place_of_.size() ? place_of_[cell.index()] : CellId::none_value;
  }
  /// Returns the area of the node's polygons that faces w (m2).
  double facing_m2(std::uint32_t node, const Vec3& w) const;

 private:
  struct Leaf;
  std::uint32_t add_cells(std::uint32_t first, std::uint32_t end,
                          std::span<const std::vector<Leaf>> leaves, std::span<const Box> boxes);
  std::uint32_t add_clusters(std::span<Leaf> leaves, std::uint32_t place);
  std::uint32_t add_parent(std::uint32_t at, std::uint32_t left, std::uint32_t right);

  std::vector<Node> nodes_;
  std::vector<ClusterId> clusters_;
  std::vector<CellId> cells_;
  std::vector<std::uint32_t> leaf_of_, place_of_;
};

}  // namespace enfilade
