// Edge cut and imbalance of an assignment.
#include <algorithm>

#include "assignment/assignment.hpp"
#include "base/error.hpp"

namespace enfilade {

PartitionQuality quality(const ClusterGraph& graph, std::span<const Rank> owner, int parts) {
  ENFILADE_CHECK(owner.size() == graph.size() && parts >= 1, std::to_string(owner.size()));
  PartitionQuality q;
  std::vector<std::size_t> size(static_cast<std::size_t>(parts), 0);
  for (std::size_t v = 0; v < graph.size(); ++v) {
    ++size[static_cast<std::size_t>(owner[v].value)];
    for (std::uint32_t to : graph.neighbours(v)) {
      if (v < to && owner[v] != owner[to]) ++q.edge_cut;
    }
  }
  if (graph.size() > 0) {
    const double mean = static_cast<double>(graph.size()) / parts;
    q.imbalance = static_cast<double>(*std::max_element(size.begin(), size.end())) / mean;
  }
  return q;
}

}  // namespace enfilade
