// The far field of a solve: the building's tree, its light, and what cells see.
#pragma once

#include <memory>
#include <optional>

#include "coarse/far_flow.hpp"
#include "far_field/far_view.hpp"
#include "gather/gather.hpp"
#include "preparation/preparation.hpp"

namespace enfilade {

/// The topmost shooters that links start from.
enum class Hierarchy {
  /// The building as a whole: far rooms and groups of clusters shoot as one. With few clusters,
  /// each
  /// cluster of the cells in view.
  building,
  clusters,  ///< each cluster that G_cluster calls visible, as in the paper
};

inline const char* name_of(Hierarchy hierarchy) {
  return hierarchy == Hierarchy::building ? "building" : "clusters";
}

class BuildingField {
 public:
  /// All must outlive it; `unknowns` as well.
  BuildingField(const Prepared& prepared, const CoarseUnknowns& unknowns, Hierarchy hierarchy);

  bool has_tree() const { return light_ != nullptr; }
  /// The same before the field is made.
  static bool has_tree(Hierarchy hierarchy, std::size_t clusters);
  Hierarchy hierarchy() const { return hierarchy_; }
  std::size_t bands() const { return light_->bands(); }
  /// Takes a cluster's light after its gather.
  void set(ClusterId cluster, std::span<const double> light) { light_->set(cluster, light); }
  /// Ends an iteration: corrects the light that was set by the coarse correction's changes (may be
  /// empty), and sums it up for the next one.
  void end_iteration(std::span<const double> changes);
  /// Returns where a receiver's shooters come from. `listed` is room for a list that the result
  /// refers to.
  Shooters shooters(ClusterId receiver, std::vector<ClusterId>& listed) const;
  /// True where all shooters of a receiver are known before its gather.
  bool lists_shooters() const { return !has_tree(); }

 private:
  bool sees_outside(ClusterId receiver) const;

  const Prepared& prepared_;
  const CoarseUnknowns& unknowns_;
  Hierarchy hierarchy_;
  bool far_lights_ = false;             ///< the scene has a sky, a sun or a ground
  CellId outside_;                      ///< with far lights: CellComplex::outside()
  std::unique_ptr<CellSights> sights_;  ///< unless G_cluster is used and there are no far lights
  // With a tree:
  std::unique_ptr<BuildingTree> tree_;
  std::unique_ptr<BuildingLight> light_;
  std::unique_ptr<FarField> field_;
  std::unique_ptr<FarUnknowns> far_unknowns_;
};

}  // namespace enfilade
