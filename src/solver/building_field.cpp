#include "solver/building_field.hpp"

#include <algorithm>

namespace enfilade {
namespace {

/// Below so many clusters all pairs are few, and far nodes would only add noise.
constexpr std::size_t least_clusters_of_tree = 128;

}  // namespace

BuildingField::BuildingField(const Prepared& prepared, const CoarseUnknowns& unknowns,
                             Hierarchy hierarchy)
    : prepared_(prepared), unknowns_(unknowns), hierarchy_(hierarchy) {
  far_lights_ = std::any_of(prepared.scene.lights.begin(), prepared.scene.lights.end(),
                            [](const LightSource& light) { return light.is_far(); });
  if (hierarchy == Hierarchy::clusters && !far_lights_) return;
  if (far_lights_) outside_ = prepared.cells.outside();
  sights_ = std::make_unique<CellSights>(prepared.cells, prepared.clusters);
  if (!has_tree(hierarchy, prepared.clusters.size())) return;
  tree_ = std::make_unique<BuildingTree>(prepared.clusters);
  light_ = std::make_unique<BuildingLight>(*tree_, prepared.scene, prepared.clusters);
  field_ = std::make_unique<FarField>(*tree_, *light_, *sights_);
  far_unknowns_ = std::make_unique<FarUnknowns>(*light_, unknowns_);
}

bool BuildingField::has_tree(Hierarchy hierarchy, std::size_t clusters) {
  return hierarchy == Hierarchy::building && clusters >= least_clusters_of_tree;
}

void BuildingField::end_iteration(std::span<const double> changes) {
  if (!has_tree()) return;
  if (!changes.empty()) {
    for (const Cluster& cluster : prepared_.clusters) {
      light_->correct(cluster.id, unknowns_.of(cluster.id, changes, light_->bands()));
    }
  }
  light_->sum();
  far_unknowns_ = std::make_unique<FarUnknowns>(*light_, unknowns_);
}

Shooters BuildingField::shooters(ClusterId receiver, std::vector<ClusterId>& listed) const {
  const bool outside = !far_lights_ || sees_outside(receiver);
  if (has_tree()) return {{}, field_.get(), far_unknowns_.get(), outside};
  if (hierarchy_ == Hierarchy::clusters) {
    listed = prepared_.graph.visible_to(receiver);
    return {listed, nullptr, nullptr, outside};
  }
  const std::vector<CellId> seen = sights_->seen_by(receiver);
  for (const Cluster& cluster : prepared_.clusters) {
    const std::span<const CellId> lies_in = sights_->cells_of(cluster.id);
    if (std::any_of(lies_in.begin(), lies_in.end(), [&seen](CellId cell) {
          return std::binary_search(seen.begin(), seen.end(), cell);
        })) {
      listed.push_back(cluster.id);
    }
  }
  return {listed, nullptr, nullptr, outside};
}

bool BuildingField::sees_outside(ClusterId receiver) const {
  const std::span<const CellId> own = sights_->cells_of(receiver);
  return outside_.valid() && std::any_of(own.begin(), own.end(), [this](CellId cell) {
           const std::vector<CellId>& seen = sights_->seen_from(cell);
           return std::binary_search(seen.begin(), seen.end(), outside_);
         });
}

}  // namespace enfilade
