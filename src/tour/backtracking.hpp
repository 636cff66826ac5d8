// Depth first through G_cluster, and back where it ends: one of the orders that [7] and [10]
// compare.
#pragma once

#include "tour/order.hpp"

namespace enfilade {

/// RR-3425 §7 names 'back tracking' among the orders that the travelling salesman beats, and tells
/// no more of it. This is our reconstruction: from a cluster on to the cheapest one (by OVG) of
/// those that it sees and that have not had their turn; where there is none, back along the path to
/// the last cluster that still sees one. It starts with the first cluster, and again with the first
/// one left where nothing more can be reached. Takes a cost for every edge of G_cluster at most.
class Backtracking final : public Order {
 public:
  std::vector<ClusterId> arrange(std::vector<ClusterId> clusters,
                                 const VisibilityCost& cost) const override;
};

}  // namespace enfilade
