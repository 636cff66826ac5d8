// Depth-first traversal with an explicit stack.
#include "tour/backtracking.hpp"

#include <algorithm>

namespace enfilade {
namespace {

/// A cluster on the path: the clusters to go on to from it, the cheapest last.
struct Step {
  std::vector<ClusterId> onward;
};

Step step_from(ClusterId cluster, const std::vector<bool>& free, const VisibilityCost& cost) {
  std::vector<std::pair<std::uint64_t, ClusterId>> priced;
  for (const std::uint32_t n : cost.graph().neighbours(cluster.index())) {
    if (free[n]) priced.emplace_back(cost.between(cluster, ClusterId(n)), ClusterId(n));
  }
  std::sort(priced.begin(), priced.end(), std::greater<>());
  Step step;
  for (const auto& [bytes, to] : priced) step.onward.push_back(to);
  return step;
}

}  // namespace

std::vector<ClusterId> Backtracking::arrange(std::vector<ClusterId> clusters,
                                             const VisibilityCost& cost) const {
  std::vector<bool> free(cost.graph().size(), false);  // of this rank, and not yet in the order
  for (const ClusterId c : clusters) free[c.index()] = true;
  std::vector<ClusterId> order;
  std::vector<Step> path;
  const auto visit = [&](ClusterId c) {
    free[c.index()] = false;
    order.push_back(c);
    path.push_back(step_from(c, free, cost));
  };
  for (const ClusterId start : clusters) {
    if (!free[start.index()]) continue;
    visit(start);
    while (!path.empty()) {
      auto& onward = path.back().onward;
      while (!onward.empty() && !free[onward.back().index()]) onward.pop_back();
      onward.empty() ? path.pop_back() : visit(onward.back());
    }
  }
  return order;
}

}  // namespace enfilade
