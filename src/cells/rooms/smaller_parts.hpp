// The connected parts of a graph but the largest one, in time that grows with them alone.
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
/// of these parts. The searches from all starts go on by turns, that of the fewest nodes first,
/// until one is left: it has what the others have not.
std::vector<std::uint32_t> smaller_parts(std::span<const std::uint32_t> starts,
                                         const PartGraph& graph);

}  // namespace enfilade
