// Clusters to ranks: G_val, figure 1's K-means, METIS, round robin (§3.3.1).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/ids.hpp"
#include "visibility/cluster_graph.hpp"

namespace enfilade {

enum class AssignmentMethod { kmeans, metis, round_robin };
/// Throws InputError for a name that is none of kmeans, metis, round-robin.
AssignmentMethod assignment_method(const std::string& name);

struct AssignmentConfig {
  AssignmentMethod method = AssignmentMethod::kmeans;
  int parts = 1;
  std::uint64_t seed = 1;
  int max_iterations = 30;  ///< of figure 1's loop, which changes little after ten
};

/// owner[i] = the rank that cluster i is assigned to, 0 .. parts-1. Where there are at least as
/// many clusters as parts, no part is empty.
std::vector<Rank> assign(const ClusterGraph& graph, const AssignmentConfig& config);

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
