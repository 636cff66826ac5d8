// The cluster first whose surroundings have the most unshot energy: one of the orders that [7] and
// [10] compare, and [8]'s second step (§2.2).
#pragma once

#include "tour/order.hpp"

namespace enfilade {

/// Where light is gathered and not shot, the unshot energy of a receiver is the change in power of
/// all clusters that it sees since its own last gather. This is our reconstruction of 'maximum
/// energy' (§7). A rank has the changes of its own gathers; of other ranks' clusters it has their
/// emitted power alone, since later changes would cost the messages and reads that an order is to
/// save.
class UnshotEnergy final : public Order {
 public:
  /// `graph` must outlive it. At first each cluster's emitted power is unshot.
  UnshotEnergy(const ClusterGraph& graph, const std::vector<double>& emitted_power);

  std::vector<ClusterId> arrange(std::vector<ClusterId> clusters,
                                 const VisibilityCost&) const override {
    return clusters;
  }
  std::size_t choose(std::span<const ClusterId> waiting) const override;
  void gathered(ClusterId receiver, double change_power) override;
  /// Returns the power that a cluster has not gathered yet.
  double waiting_power(ClusterId receiver) const { return power_[receiver.index()]; }

 private:
  void shoot(ClusterId from, double power);

  const ClusterGraph* graph_;
  std::vector<double> power_;
};

}  // namespace enfilade
