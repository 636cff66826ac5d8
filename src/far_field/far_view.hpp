// The far field as one receiving cluster sees it: which nodes of the building's tree may send light
// to it.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <vector>

#include "far_field/building_light.hpp"
#include "far_field/portal_exchange.hpp"
#include "visibility/cell_sights.hpp"

namespace enfilade {

/// A unit vector as two numbers in [-1, 1]: by its place on an octahedron that is unfolded (Meyer
/// et al. 2010), and back. The vector 0, all directions, is (2, 2).
Vec2 fold_direction(const Vec3& w);
Vec3 unfold_direction(const Vec2& folded);

/// The part of the building's tree that a receiver may see, by cells and portals.
class TreeSight {
 public:
  TreeSight(const BuildingTree& tree, const CellSights& sights, std::vector<CellId> cells);
  /// False where it is certain that nothing of the node is visible.
  bool may_see(const BuildingTree& tree, const CellSights& sights, std::uint32_t node) const;

 private:
  bool sees_cluster(const CellSights& sights, ClusterId cluster) const;

  std::vector<CellId> cells_;          ///< that it sees, ascending
  std::vector<std::uint32_t> places_;  ///< in the tree, ascending: cells with a cluster in view
};

/// What all gathers of an iteration share.
class FarField {
 public:
  /// All must outlive it.
  FarField(const BuildingTree& of_tree, const BuildingLight& of_light, const CellSights& of_cells)
      : tree(of_tree), light(of_light), sights(of_cells), exchange(of_tree, of_cells) {}
  std::shared_ptr<const TreeSight> sight_of(ClusterId receiver) const;

  const BuildingTree& tree;
  const BuildingLight& light;
  const CellSights& sights;
  const PortalExchange exchange;

 private:
  /// By the cells that clusters lie in, once they are asked for.
  mutable std::map<std::vector<CellId>, std::shared_ptr<const TreeSight>> sights_;
};

/// The far field as one receiving cluster sees it.
class FarView {
 public:
  FarView(const FarField& field, ClusterId receiver) : field_(field), receiver_(receiver) {}

  const BuildingTree& tree() const { return field_.tree; }
  const BuildingLight& light() const { return field_.light; }
  /// False where it is certain, by cells and portals, that nothing of the node is visible.
  bool may_see(std::uint32_t node) const {
    if (!sight_) sight_ = field_.sight_of(receiver_);
    return sight_->may_see(field_.tree, field_.sights, node);
  }
  /// PortalExchange::bound_m2 between the node and what lies in `box`, polygons of `m2` of the
  /// receiving cluster.
  double portal_m2(std::uint32_t node, const Box& box, double m2) const {
    return field_.exchange.bound_m2(field_.sights.cells_of(receiver_), box, m2, node);
  }
  /// Returns a cluster of the node, drawn by its estimated share of what they send to x. `pick` is
  /// uniform in [0, 1); what is left of it is again. `probability` becomes the cluster's.
  ClusterId pick_cluster(std::uint32_t node, const Vec3& x, double& pick,
                         double& probability) const;
  /// Returns the probability that pick_cluster() draws this cluster of the node.
  double probability_of(std::uint32_t node, const Vec3& x, ClusterId cluster) const;
  bool contains(std::uint32_t node, ClusterId cluster) const {
    const std::uint32_t place = tree().node(tree().leaf_of(cluster)).begin;
    return tree().node(node).begin <= place && place < tree().node(node).end;
  }

 private:
  double share_of_left(const BuildingTree::Node& node, const Vec3& x) const;

  const FarField& field_;
  ClusterId receiver_;
  mutable std::shared_ptr<const TreeSight> sight_;  ///< once it is asked for
};

}  // namespace enfilade
