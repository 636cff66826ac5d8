// By cluster, the power of all that it sees that has changed since its last gather.
#include "tour/unshot_energy.hpp"

#include "base/error.hpp"

namespace enfilade {

UnshotEnergy::UnshotEnergy(const ClusterGraph& graph, const std::vector<double>& emitted_power)
    : graph_(&graph), power_(graph.size(), 0.0) {
  ENFILADE_CHECK(emitted_power.size() == graph.size(), std::to_string(emitted_power.size()));
  for (std::size_t c = 0; c < graph.size(); ++c) shoot(ClusterId(c), emitted_power[c]);
}

void UnshotEnergy::shoot(ClusterId from, double power) {
  power_[from.index()] += power;  // a cluster sees itself
  for (const std::uint32_t n : graph_->neighbours(from.index())) power_[n] += power;
}

void UnshotEnergy::gathered(ClusterId receiver, double change_power) {
  power_[receiver.index()] = 0.0;
  shoot(receiver, change_power);
}

std::size_t UnshotEnergy::choose(std::span<const ClusterId> waiting) const {
  std::size_t best = 0;  // of equals the first in CYCLE
  for (std::size_t i = 1; i < waiting.size(); ++i) {
    if (waiting_power(waiting[i]) > waiting_power(waiting[best])) best = i;
  }
  return best;
}

}  // namespace enfilade
