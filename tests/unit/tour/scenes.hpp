// Visibility graphs with bytes that the tests of this room share.
#pragma once

#include <numeric>
#include <utility>
#include <vector>

#include "base/random.hpp"
#include "tour/tour.hpp"

namespace enfilade::test {

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// Each pair is an edge with the given probability.
inline ClusterGraph random_graph(std::uint32_t nodes, double probability, std::uint64_t seed) {
  Random random(seed);
  Pairs pairs;
  for (std::uint32_t a = 0; a < nodes; ++a) {
    for (std::uint32_t b = a + 1; b < nodes; ++b) {
      if (random.uniform() < probability) pairs.emplace_back(a, b);
    }
  }
  return ClusterGraph(nodes, pairs);
}

/// Rooms in a row whose clusters' ids are shuffled over the building; each cluster sees its room
/// and half of the next one.
inline ClusterGraph shuffled_rooms(std::uint32_t rooms, std::uint32_t clusters_a_room,
                                   std::uint64_t seed) {
  Random random(seed);
  const std::uint32_t n = rooms * clusters_a_room;
  std::vector<std::uint32_t> name(n);
  std::iota(name.begin(), name.end(), 0u);
  for (std::uint32_t i = n; i > 1; --i) std::swap(name[i - 1], name[random.below(i)]);
  Pairs pairs;
  for (std::uint32_t a = 0; a < n; ++a) {
    for (std::uint32_t b = a + 1; b < n; ++b) {
      const std::uint32_t apart = b / clusters_a_room - a / clusters_a_room;
      if (apart == 0 || (apart == 1 && random.uniform() < 0.5))
        pairs.emplace_back(name[a], name[b]);
    }
  }
  return ClusterGraph(n, pairs);
}

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
