// The connected parts of a graph but the largest one, without walking through that.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace enfilade {

struct PartGraph {
  /// Calls its argument with each neighbour of a node.
  std::function<void(std::uint32_t, const std::function<void(std::uint32_t)>&)> neighbours;
  std::function<double(std::uint32_t)> size;
  double whole = 0.0;  ///< size of all nodes
};

/// Returns the nodes, ascending, of all connected parts that hold one of `starts` but the largest
/// of these parts. Searches from all starts take turns, the one that has found the fewest nodes
/// first. When one is left, its part is taken to have all of graph.whole that the others have not,
/// and the search ends if that is the most: a part without a start counts as its own.
std::vector<std::uint32_t> smaller_parts(std::span<const std::uint32_t> starts,
                                         const PartGraph& graph);

}  // namespace enfilade
