// What a link means to the coarse system.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "hierarchy/aggregates.hpp"
#include "hierarchy/link.hpp"

namespace enfilade {

/// What flows by reflection from one shooting cluster's aggregates to the receiving one's.
class AggregateFlow {
 public:
  /// All must outlive it.
  AggregateFlow(const PatchForest& receiver, const Aggregates& receiving,
                const PatchForest& shooter, const Aggregates& shooting);

  /// A link's power per band: what its shooter reflects, as it arrives.
  void add(const Link& link, std::span<const float> transport, std::span<const double> power);
  /// [(receiving aggregate * shooting aggregates + shooting aggregate) * bands + band]
  std::vector<double> take() { return std::move(flow_); }

 private:
  void share_received(const Link& link, std::span<const float> transport);
  void share_sent(PatchId node);

  const PatchForest &receiver_, &shooter_;
  const Aggregates &receiving_, &shooting_;
  std::size_t bands_;
  std::vector<double> reflected_;  ///< [shooting aggregate * bands + band]
  std::vector<double> received_;   ///< share of the link at hand, by receiving aggregate
  std::vector<double> sent_;       ///< and by shooting aggregate, per band
  Aggregates::Range from_;         ///< shooting aggregates of the link at hand
  std::vector<double> flow_;
};

}  // namespace enfilade
