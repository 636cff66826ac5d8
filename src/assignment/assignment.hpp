// Clusters to ranks: G_val, figure 1's K-means, and what it is compared with: METIS, the greedy
// groups of [6], round robin (§3.3.1).
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
/// kmeans, metis, greedy, round-robin: what users call the methods, in the enum's order.
std::span<const char* const> assignment_names();
const char* name_of(AssignmentMethod method);
/// Throws InputError for a name that is none of these.
AssignmentMethod assignment_method(const std::string& name);

struct AssignmentConfig {
  AssignmentMethod method = AssignmentMethod::kmeans;
  int parts = 1;
  std::uint64_t seed = 1;
  int max_iterations = 30;  ///< of figure 1's loop, which changes little after ten
  int starts = 4;           ///< kmeans: choices of first centres, of which the best is taken
};

/// owner[i] = the rank that cluster i is assigned to, 0 .. parts-1. Where there are at least as
/// many clusters as parts, no part is empty. Only `greedy` looks at the weights of the edges; all
/// others count hops or edges.
std::vector<Rank> assign(const ClusterGraph& graph, const FormFactorEstimate& weights,
                         const AssignmentConfig& config);

/// The same, with the form factors between the clusters as weights. clusters[i] is node i.
std::vector<Rank> assign_clusters(const ClusterGraph& graph, std::span<const Cluster> clusters,
                                  const AssignmentConfig& config);

/// Hops from `source` to every node of G_val (breadth-first: Warshall's answer, row by row);
/// unreachable = 0xFFFFFFFF.
std::vector<std::uint32_t> hop_distances(const ClusterGraph& graph, std::size_t source);

/// Number of edges between different parts, and largest part over mean part.
struct PartitionQuality {
  std::size_t edge_cut = 0;
  double imbalance = 1.0;
};
PartitionQuality quality(const ClusterGraph& graph, std::span<const Rank> owner, int parts);

}  // namespace enfilade
