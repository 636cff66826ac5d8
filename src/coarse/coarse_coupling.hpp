// What a link means to the coarse system.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "hierarchy/coarse_zones.hpp"
#include "hierarchy/link.hpp"

namespace enfilade {

/// What flows by reflection from one shooting cluster's zones to the receiving one's.
class ZoneFlow {
 public:
  /// All must outlive it.
  ZoneFlow(const PatchForest& receiver, const CoarseZones& receiving, const PatchForest& shooter,
           const CoarseZones& shooting);

  /// A link's power per band: what its shooter reflects, as it arrives.
  void add(const Link& link, std::span<const float> transport, std::span<const double> power);
  /// [(receiving zone * shooting zones + shooting zone) * bands + band]
  std::vector<double> take() { return std::move(flow_); }

 private:
  void share_received(const Link& link, std::span<const float> transport);
  void share_sent(PatchId node);

  const PatchForest &receiver_, &shooter_;
  const CoarseZones &receiving_, &shooting_;
  std::size_t bands_;
  std::vector<double> reflected_;  ///< [shooting zone * bands + band]
  std::vector<double> received_;   ///< share of the link at hand, by receiving zone
  std::vector<double> sent_;       ///< and by shooting zone, per band
  CoarseZones::Range from_;        ///< shooting zones of the link at hand
  std::vector<double> flow_;
};

}  // namespace enfilade
