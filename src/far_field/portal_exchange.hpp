// How much light portals let pass, at most, from a node of the building's tree to a receiver in
// other cells: an upper bound of their direct exchange area (area times form factor; Hottel and
// Sarofim 1967). A far node may be large, bright and near, and yet send next to nothing, since its
// light must leave by doorways and arrive by others.
#pragma once

#include <map>
#include <span>
#include <vector>

#include "clusters/building_tree.hpp"
#include "visibility/cell_sights.hpp"

namespace enfilade {

class PortalExchange {
 public:
  /// Both must outlive it.
  PortalExchange(const BuildingTree& tree, const CellSights& sights);

  /// Returns an upper bound of the direct exchange area, m2, between polygons of `m2` in all that
  /// lie within `box` in the cells `own`, and all polygons of the node: infinite where some of
  /// these lie in one of the cells, 0 where no line leads from one to the other.
  double bound_m2(std::span<const CellId> own, const Box& box, double m2, std::uint32_t node) const;

 private:
  /// The doorways by which lines from elsewhere enter a node.
  struct Entries {
    double m2 = 0.0;
    Box box;
    void add(const Doorway& doorway);
  };
  bool shares_cell(std::span<const CellId> own, const BuildingTree::Node& node) const;
  bool is_one_cell(const BuildingTree::Node& node) const {
    return node.end_cell - node.first_cell == 1;
  }
  const Entries& entries_of(std::uint32_t node) const {
    const BuildingTree::Node& n = tree_.node(node);
    return is_one_cell(n) ? of_place_[n.first_cell] : of_node_[node];
  }
  double from_doorway(const Doorway& out, std::uint32_t node) const;
  /// Adds a doorway to the cell at `place` and to the nodes above it; a doorway from another cell
  /// of the same node (the one at `from_place`) is no entry of that node.
  void add_entry(const Doorway& doorway, std::uint32_t place, std::uint32_t from_place);

  const BuildingTree& tree_;
  const DoorwayMap& doorways_;
  std::vector<Entries> of_node_;   ///< of nodes of several cells
  std::vector<Entries> of_place_;  ///< of cells, by their place in the tree
  std::vector<std::vector<const Doorway*>>
      doorways_of_place_;  ///< which those are, facing outwards
  /// By cell, the places of clusters that have polygons there and lie in another cell.
  std::map<CellId, std::vector<std::uint32_t>> reach_into_;
};

}  // namespace enfilade
