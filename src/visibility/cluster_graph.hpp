// G_cluster: the pairs of clusters that can see each other (§3.2). Conservative: a visible pair is
// never missing.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/progress.hpp"
#include "cells/partition/cell_complex.hpp"
#include "clusters/building_tree.hpp"
#include "clusters/cluster.hpp"
#include "visibility/occlusion.hpp"

namespace enfilade {

/// Undirected graph in compressed rows: the neighbours of i are sorted and differ from i; every
/// cluster is taken to see itself, without an edge.
class ClusterGraph {
 public:
  ClusterGraph() = default;
  /// Pairs may come in any order, either way round and several times.
  ClusterGraph(std::size_t clusters, std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs);

  std::size_t size() const { return offsets_.empty() ? 0 : offsets_.size() - 1; }
  std::size_t edges() const { return targets_.size() / 2; }
  std::span<const std::uint32_t> neighbours(std::size_t i) const {
    return {targets_.data() + offsets_[i], targets_.data() + offsets_[i + 1]};
  }
  bool has_edge(std::size_t i, std::size_t j) const;
  /// Returns the clusters whose light may reach this one, itself among them, in ascending order.
  std::vector<ClusterId> visible_to(ClusterId receiver) const;

 private:
  std::vector<std::size_t> offsets_;
  std::vector<std::uint32_t> targets_;
};

/// Joins each cluster with the `reach` next ones in the order of the building's tree: a graph that
/// keeps what lies together together, of a size that grows with the clusters. Ranks share a
/// building by it where nothing asks for G_cluster.
ClusterGraph neighbour_graph(const BuildingTree& tree, std::size_t reach = 8);

/// Returns the graph as bytes (versioned, in this machine's byte order), and back. Throws RunError
/// where the bytes are no such graph.
std::string to_bytes(const ClusterGraph& graph);
ClusterGraph graph_from_bytes(std::string_view bytes);

/// The effort spent on visibility, before coarser answers that are conservative as well are taken.
struct VisibilityConfig {
  int max_passes = 2;        ///< sequences of a source followed one by one through one doorway
  bool prove_hidden = true;  ///< drop windows and pairs that are proved hidden by occluders
  OcclusionConfig occlusion;
};

/// Returns G_cell: pairs (a <= b) of cells that see each other through a sequence of portals; a
/// cell sees itself.
std::vector<std::pair<CellId, CellId>> visible_cells(const CellComplex& complex,
                                                     const VisibilityConfig& config = {});

/// Returns G_cluster: it joins clusters of one cell unless neither has a front side before the
/// other's, and clusters of different cells that see each other through a sequence of portals. Each
/// cluster is a source of its own, so that G_cluster is tighter than G_cell. With `prove_hidden`
/// occluders tighten it further (occlusion.hpp): first between a cluster and each portal of a
/// sequence, where a proof ends all sequences through that portal, then between the pairs of
/// clusters that are left.
ClusterGraph visible_clusters(const CellComplex& complex, std::span<const Cluster> clusters,
                              const Progress& progress = {}, const VisibilityConfig& config = {});

}  // namespace enfilade
