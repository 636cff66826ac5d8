// Bytes of clusters and the cost of a round, for the tests of this room.
#pragma once

#include <vector>

#include "tour/tour.hpp"
#include "unit/visibility/test_graphs.hpp"

namespace enfilade::test {

inline std::vector<std::uint64_t> random_bytes(std::size_t clusters, std::uint64_t seed) {
  Random random(seed);
  std::vector<std::uint64_t> bytes(clusters);
  for (auto& b : bytes) b = 100 + random.below(10000);
  return bytes;
}

inline std::vector<ClusterId> all_clusters(const ClusterGraph& graph) {
  std::vector<ClusterId> clusters;
  for (std::size_t i = 0; i < graph.size(); ++i) clusters.emplace_back(i);
  return clusters;
}

inline std::uint64_t round_cost(const std::vector<ClusterId>& order, const VisibilityCost& cost) {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    sum += cost.between(order[i], order[(i + 1) % order.size()]);
  }
  return sum;
}

}  // namespace enfilade::test
