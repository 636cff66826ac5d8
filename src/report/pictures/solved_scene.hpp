// The parts of a solved run that pictures, tables and models are made from.
#pragma once

#include <span>

#include "hierarchy/cluster_state.hpp"
#include "report/plans/planned_building.hpp"
#include "scene/scene.hpp"

namespace enfilade {

/// Refers to its parts, which must outlive it. states[c] is the solution of clusters[c].
struct SolvedScene {
  const Scene& scene;
  const CellComplex& cells;
  std::span<const Cluster> clusters;
  std::span<const ClusterState> states;
  const Occluders& occluders;  ///< made of `clusters`

  PlannedBuilding building() const { return {cells, clusters, occluders}; }
};

}  // namespace enfilade
