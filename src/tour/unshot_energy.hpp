// The cluster first for which most light waits: one of the orders that [7] and [10] compare, and
// [8]'s second step (§2.2).
#pragma once

#include "tour/order.hpp"

namespace enfilade {

/// Where light is gathered and not shot, the light that waits for a receiver is the change of all
/// that it sees since its own last turn. This is our reconstruction of 'maximum energy' (§7).
/// A rank knows what its own gathers changed; of other ranks' clusters it knows what they emit, and
/// nothing later, since hearing of it would cost the messages and reads that an order is to save.
class UnshotEnergy final : public Order {
 public:
  /// `graph` must outlive it. At first each cluster's own exitance has yet to arrive.
  UnshotEnergy(const ClusterGraph& graph, const std::vector<double>& emitted_power);

  std::vector<ClusterId> arrange(std::vector<ClusterId> clusters,
                                 const VisibilityCost&) const override {
    return clusters;
  }
  std::size_t choose(std::span<const ClusterId> waiting) const override;
  void gathered(ClusterId receiver, double change_power) override;
  /// Power that has not arrived at a cluster.
  double waiting_power(ClusterId receiver) const { return power_[receiver.index()]; }

 private:
  void shoot(ClusterId from, double power);

  const ClusterGraph* graph_;
  std::vector<double> power_;
};

}  // namespace enfilade
