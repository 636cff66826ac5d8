// The paper's own way to the hops between all clusters, to compare with.
#pragma once

#include <algorithm>
#include <vector>

#include "unit/visibility/test_graphs.hpp"

namespace enfilade::test {

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
