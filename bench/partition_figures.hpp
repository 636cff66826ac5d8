// How good an assignment is, in figures that do not depend on the machine.
#pragma once

#include <span>

#include "assignment/assignment.hpp"
#include "cluster_figures.hpp"

namespace enfilade::bench {

struct PartitionFigures {
  double cut_share = 0.0;  ///< of G_cluster's pairs, those with two owners
  double form_factor_cut_share =
      0.0;                        ///< the same, each pair counted with its estimated form factor
  double work_balance = 1.0;      ///< largest rank over mean rank, of ClusterFigures::work
  double clusters_balance = 1.0;  ///< the same, of the number of clusters
  double mean_foreign_bytes =
      0.0;  ///< that a rank must load in an iteration: the clusters of others
  double max_foreign_bytes = 0.0;  ///< that its own may see, each once however many see it
};

PartitionFigures partition_figures(const ClusterGraph& graph, const FormFactorEstimate& weights,
                                   const ClusterFigures& clusters, std::span<const Rank> owner,
                                   int parts);

}  // namespace enfilade::bench
