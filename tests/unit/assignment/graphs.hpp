// Graphs that the tests of this room share.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "base/random.hpp"
#include "visibility/cluster_graph.hpp"

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

/// A building: rooms in a row on each floor. Clusters of a room all see each other; each sees some
/// of the next.
inline ClusterGraph building(std::uint32_t floors, std::uint32_t rooms,
                             std::uint32_t clusters_a_room, double through_door,
                             std::uint64_t seed) {
  Random random(seed);
  Pairs pairs;
  const std::uint32_t c = clusters_a_room;
  for (std::uint32_t room = 0; room < floors * rooms; ++room) {
    const bool last_of_floor = (room + 1) % rooms == 0;
    for (std::uint32_t a = room * c; a < (room + 1) * c; ++a) {
      for (std::uint32_t b = a + 1; b < (room + 1) * c; ++b) pairs.emplace_back(a, b);
      for (std::uint32_t b = (room + 1) * c; !last_of_floor && b < (room + 2) * c; ++b) {
        if (random.uniform() < through_door) pairs.emplace_back(a, b);
      }
    }
    // Stairs: the last room of a floor sees the last room of the next one.
    if (last_of_floor && room + rooms < floors * rooms)
      pairs.emplace_back(room * c, (room + rooms) * c);
  }
  return ClusterGraph(floors * rooms * c, pairs);
}

/// Warshall's algorithm as the paper uses it: hops between all pairs, `nodes` where there is no
/// path.
inline std::vector<std::vector<std::uint32_t>> warshall(const ClusterGraph& graph) {
  const std::size_t n = graph.size();
  std::vector<std::vector<std::uint32_t>> d(
      n, std::vector<std::uint32_t>(n, static_cast<std::uint32_t>(n)));
  for (std::size_t v = 0; v < n; ++v) {
    d[v][v] = 0;
    for (std::uint32_t to : graph.neighbours(v)) d[v][to] = 1;
  }
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) d[i][j] = std::min(d[i][j], d[i][k] + d[k][j]);
    }
  }
  return d;
}

}  // namespace enfilade::test
