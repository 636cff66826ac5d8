// The importance of a receiving cluster's nodes (solver/importance.hpp): how much an error of their
// irradiance matters, relative to the mean over the scene.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "hierarchy/cluster_state.hpp"
#include "occluders/occluders.hpp"

namespace enfilade {

class ReceiverImportance {
 public:
  /// `by_polygon`: of all polygons, by their global numbers; empty = 1 everywhere. Must outlive it.
  ReceiverImportance(const ClusterState& receiver, const Occluders& occluders,
                     std::span<const float> by_polygon) {
    if (by_polygon.empty()) return;
    const PatchForest& patches = receiver.patches();
    polygons_ = by_polygon.subspan(occluders.global(receiver.id(), 0), patches.polygons());
    for (const GroupNode& group : patches.groups()) {
      float most = 0.0f;
      for (std::uint32_t i = group.begin; i < group.end; ++i)
        most = std::max(most, polygons_[patches.order()[i]]);
      groups_.push_back(most);
    }
  }

  /// Returns the importance of a patch's polygon, or the largest of a group's polygons.
  double of(PatchId node) const {
    if (polygons_.empty()) return 1.0;
    return node.is_group() ? groups_[node.group()] : polygons_[node.root];
  }

 private:
  std::span<const float> polygons_;
  std::vector<float> groups_;
};

}  // namespace enfilade
