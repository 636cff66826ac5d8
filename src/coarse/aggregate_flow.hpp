// The power that flows by reflection from the aggregates of one cluster to those of another, summed
// over links: entries of the coarse system.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "hierarchy/aggregates.hpp"
#include "hierarchy/link.hpp"

namespace enfilade {

/// Returns the shares of a link's power by receiving aggregate.
std::vector<double> received_shares(const PatchForest& receiver, const Aggregates& receiving,
                                    const Link& link, std::span<const float> transport);

/// Sums the links from one shooting cluster to one receiving cluster.
class AggregateFlow {
 public:
  /// All must outlive it.
  AggregateFlow(const PatchForest& receiver, const Aggregates& receiving,
                const PatchForest& shooter, const Aggregates& shooting);

  /// Adds a link. `power`: reflected power per band that it brings to its receiver.
  void add(const Link& link, std::span<const float> transport, std::span<const double> power);
  /// Returns the flows, [(receiving aggregate * shooting aggregates + shooting aggregate) * bands +
  /// band].
  std::vector<double> take() { return std::move(flow_); }

 private:
  void share_sent(PatchId node);

  const PatchForest &receiver_, &shooter_;
  const Aggregates &receiving_, &shooting_;
  std::size_t bands_;
  std::vector<double> reflected_;  ///< [shooting aggregate * bands + band]
  // Of the link that is being added:
  std::vector<double> received_;  ///< share of its power, by receiving aggregate
  std::vector<double> sent_;      ///< share of its power, by shooting aggregate of `from_` and band
  Aggregates::Range from_;        ///< its shooting aggregates
  std::vector<double> flow_;
};

}  // namespace enfilade
