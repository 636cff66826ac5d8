// Estimates of the work of each cluster's gather, by which a master deals clusters out (§2.2).
#pragma once

#include <vector>

#include "run/prepare.hpp"
#include "schemes/protocol/messages.hpp"

namespace enfilade {

/// In links: before a cluster's first gather, the number of pairs of one of its polygons with a
/// polygon that it may see; then the number of links of its last gather.
class WorkEstimate {
 public:
  explicit WorkEstimate(const Prepared& prepared) {
    const auto polygons = [&](std::size_t c) {
      return static_cast<double>(prepared.clusters[c].polygons.size());
    };
    for (std::size_t c = 0; c < prepared.clusters.size(); ++c) {
      double visible = polygons(c);
      for (const std::uint32_t n : prepared.graph.neighbours(c)) visible += polygons(n);
      links_.push_back(polygons(c) * visible);
    }
  }
  void learn(const GatherNote& note) {
    links_[note.cluster.index()] = static_cast<double>(note.links);
  }
  double of(ClusterId cluster) const { return links_[cluster.index()]; }

 private:
  std::vector<double> links_;
};

}  // namespace enfilade
