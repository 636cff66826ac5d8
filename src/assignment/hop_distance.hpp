// Distances in G_val: breadth-first searches, one source or 256 at once. Warshall's answer (§3.3.1)
// without its n^2 matrix and n^3 time.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/ids.hpp"
#include "visibility/cluster_graph.hpp"

namespace enfilade {

/// For every node the set of sources that are nearest to it, as a bit mask of `words` 64-bit words
/// per node. A node that no source reaches has an empty set.
struct NearestSources {
  std::size_t words = 1;
  std::vector<std::uint64_t> masks;
  std::span<const std::uint64_t> of(std::size_t node) const {
    return {masks.data() + node * words, words};
  }
};
NearestSources nearest_sources(const ClusterGraph& graph, std::span<const std::uint32_t> sources);

/// How central each node is in its own group, by its hops from the group's pivots.
struct Centrality {
  std::vector<std::uint64_t>
      sum;  ///< of hops from the pivots of its group; n hops where unreachable
  std::vector<std::uint32_t> max;  ///< largest of these hops
};
/// `group` by node; `pivots` are nodes, each of which belongs to its own group.
Centrality centrality(const ClusterGraph& graph, std::span<const std::uint32_t> group,
                      std::span<const std::uint32_t> pivots);

}  // namespace enfilade
