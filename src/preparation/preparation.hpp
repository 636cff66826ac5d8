// From a scene to what every solve starts from: pieces, cells, clusters, G_cluster (§3.2). In
// memory alone; run/prepare.hpp keeps the result in a RUN directory.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/progress.hpp"
#include "base/warnings.hpp"
#include "cells/rooms/build_cells.hpp"
#include "clusters/cluster.hpp"
#include "clusters/contact_segments.hpp"
#include "clusters/unreachable_parts.hpp"
#include "scene/scene.hpp"
#include "visibility/cluster_graph.hpp"

namespace enfilade {

struct PrepareConfig {
  CellComplex::Config cells;
  UnreachableConfig unreachable;
  ClusterConfig clusters;
  ContactConfig contacts;
  /// Find G_cluster: all pairs of clusters that see each other. Without it, Prepared::graph joins
  /// neighbours in the building's tree.
  bool cluster_graph = true;
  VisibilityConfig visibility;
};

/// What one step of the preparation took.
struct PrepareStep {
  std::string name;
  double wall_s = 0.0;
  std::uint64_t peak_rss_bytes = 0;  ///< of the process, from its start to the step's end
};

/// What every rank holds of a run: all but the light.
struct Prepared {
  Scene scene;  ///< equal bands merged (scene/equal_bands.hpp)
  CellComplex cells;
  std::vector<Cluster> clusters;
  ClusterGraph graph;              ///< G_cluster, or of neighbours, by which ranks share the work
  bool has_visibility = true;      ///< `graph` is G_cluster
  double prepare_s = 0.0;          ///< wall seconds that the preparation took
  std::vector<PrepareStep> steps;  ///< pieces, cells, clusters, visibility
  double covered_area_m2 = 0.0;    ///< of surfaces covered by coplanar ones
  Warnings warnings;               ///< what the scene gave rise to
  std::uint64_t preparation = 0;   ///< names scene, cells and clusters (RunMark::preparation)
};

/// Makes `graph` G_cluster, where it is not.
void find_visibility(Prepared& prepared, const VisibilityConfig& config,
                     const Progress& progress = {});

/// `warnings` are those of reading the scene; the preparation's own are added, and all are kept in
/// the result too. `leaks`: where the building is not closed. Throws InputError for a bad scene.
Prepared prepare_scene(const Scene& scene, const PrepareConfig& config, Warnings& warnings,
                       std::vector<Leak>& leaks, const Progress& progress = {});

}  // namespace enfilade
