// Visibility graphs that the tests of several rooms share: at random, and like buildings.
#pragma once

#include <cstdint>
#include <numeric>
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

}  // namespace enfilade::test
