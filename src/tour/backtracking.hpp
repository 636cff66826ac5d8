// Depth-first traversal of G_cluster with backtracking: one of the orders that [7] and [10]
// compare.
#pragma once

#include "tour/order.hpp"

namespace enfilade {

/// RR-3425 §7 names 'back tracking' among the orders that the travelling salesman beats, without
/// defining it. Our reconstruction: from a cluster the order goes on to the cheapest (by OVG) of
/// the clusters that it sees and that have not had their turn; where there is none, back along the
/// path to the last cluster that sees one. It starts with the first cluster, and again with the
/// first one left where no more can be reached. Computes at most one cost for each edge of
/// G_cluster.
class Backtracking final : public Order {
 public:
  std::vector<ClusterId> arrange(std::vector<ClusterId> clusters,
                                 const VisibilityCost& cost) const override;
};

}  // namespace enfilade
