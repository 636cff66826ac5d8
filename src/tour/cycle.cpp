// CYCLE: its cost, and the removal of a cluster.
#include <algorithm>

#include "tour/tour.hpp"

namespace enfilade {

std::uint64_t cost_of_round(const std::vector<ClusterId>& order, const VisibilityCost& cost) {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    sum += cost.between(order[i], order[(i + 1) % order.size()]);
  }
  return sum;
}

Cycle::Cycle(std::vector<ClusterId> order, const VisibilityCost& cost)
    : order_(std::move(order)), cost_bytes_(cost_of_round(order_, cost)) {}

void Cycle::remove(ClusterId cluster, const VisibilityCost& cost) {
  const auto at = std::find(order_.begin(), order_.end(), cluster);
  if (at == order_.end()) return;
  const std::size_t n = order_.size(), i = static_cast<std::size_t>(at - order_.begin());
  const ClusterId before = order_[(i + n - 1) % n], after = order_[(i + 1) % n];
  order_.erase(at);
  if (n == 1) {
    cost_bytes_ = 0;
    return;
  }
  cost_bytes_ -= cost.between(before, cluster) + cost.between(cluster, after);
  cost_bytes_ += cost.between(before, after);
}

}  // namespace enfilade
