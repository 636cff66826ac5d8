// Assignment of clusters to ranks: figure 1's K-means on G_val (§3.3.1), and its rivals: METIS, the
// greedy groups of [6], round robin.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "assignment/form_factor_estimate.hpp"
#include "base/ids.hpp"
#include "visibility/cluster_graph.hpp"

namespace enfilade {

enum class AssignmentMethod { kmeans, metis, greedy, round_robin };
/// Returns the methods' names on the command line, in the enum's order.
std::span<const char* const> assignment_names();
const char* name_of(AssignmentMethod method);
/// Throws InputError for a name that is none of these.
AssignmentMethod assignment_method(const std::string& name);

struct AssignmentConfig {
  AssignmentMethod method = AssignmentMethod::kmeans;
  int parts = 1;
  std::uint64_t seed = 1;
  int max_iterations = 30;  ///< of figure 1's loop, which changes little after ten
  int starts = 4;           ///< kmeans: choices of first centres; the best grouping is taken
};

/// Returns owner[i], the rank that cluster i is assigned to, 0 .. parts-1. Where there are at least
/// as many clusters as parts, no part is empty. Only `greedy` uses `weights` (as many as clusters,
/// or none); the other methods count hops or edges.
std::vector<Rank> assign(const ClusterGraph& graph, const FormFactorEstimate& weights,
                         const AssignmentConfig& config);

/// Calls assign() with the form factors between the clusters as weights. clusters[i] is node i.
std::vector<Rank> assign_clusters(const ClusterGraph& graph, std::span<const Cluster> clusters,
                                  const AssignmentConfig& config);

/// Returns the hops from `source` to every node of G_val, 0xFFFFFFFF to a node in another
/// component: one row of Warshall's matrix (§3.3.1), by breadth-first search.
std::vector<std::uint32_t> hop_distances(const ClusterGraph& graph, std::size_t source);

/// Edge cut (number of edges between different parts), and imbalance (largest part over mean part).
struct PartitionQuality {
  std::size_t edge_cut = 0;
  double imbalance = 1.0;
};
PartitionQuality quality(const ClusterGraph& graph, std::span<const Rank> owner, int parts);

}  // namespace enfilade
