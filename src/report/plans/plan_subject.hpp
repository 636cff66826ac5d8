// The subjects of a plan, which its colours show: the cells, the clusters visible from one cell, or
// the assignment of clusters to ranks.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/ids.hpp"
#include "report/plans/plan_colours.hpp"
#include "report/plans/planned_building.hpp"
#include "visibility/cluster_graph.hpp"

namespace enfilade {

/// The cells and clusters that are visible from one cell.
struct VisibleSet {
  CellId from;
  std::vector<char> cells;  ///< by cell: holds such a cluster, or is `from`, or, where one of the
                            ///< two has no cluster, is a neighbour of `from` in G_cell
  std::vector<char> clusters;  ///< by cluster: lies in `from`, or is a neighbour in G_cluster of
                               ///< one that does
};
VisibleSet visible_set(const CellComplex& complex, std::span<const Cluster> clusters,
                       const ClusterGraph& graph, CellId from);

/// How a cluster's surfaces are drawn.
struct ClusterInk {
  Rgb8 line = plan_ink::black;
  double width_px = 1.6;
  std::optional<Rgb8> fill;  ///< of what stands below the cut
  std::string tip;           ///< goes on after "cluster 12, cell 3"
};

struct PlanKey {
  Rgb8 colour{};
  std::string meaning;
  bool line = false;  ///< a line, not an area
};

struct PlanSubject {
  std::string name;                    ///< "cells", "visible" or "assignment"
  std::string subtitle;                ///< one line that describes the subject
  std::vector<Rgb8> cells;             ///< by cell
  std::vector<std::string> cell_tips;  ///< by cell
  std::vector<ClusterInk> clusters;    ///< by cluster
  std::vector<PlanKey> keys;           ///< for the legend
  bool portals = true;
};

PlanSubject cells_subject(const PlannedBuilding& building);
PlanSubject visible_subject(const PlannedBuilding& building, const VisibleSet& set);
/// owner[i] = rank of cluster i; a cell has a tint of the rank with most of its surface.
PlanSubject assignment_subject(const PlannedBuilding& building, std::span<const Rank> owner);

}  // namespace enfilade
