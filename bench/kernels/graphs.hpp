// Visibility graphs of the size that a benchmark asks for.
#pragma once

#include "unit/visibility/test_graphs.hpp"

namespace enfilade::bench {

/// Four floors of rooms with 80 clusters each; a cluster sees its room and some of the next one.
/// About 75 edges a cluster: 13,000 clusters have a million.
inline ClusterGraph building_of(std::int64_t clusters) {
  const auto rooms = static_cast<std::uint32_t>(clusters / (4 * 80));
  return test::building(4, std::max(rooms, 1u), 80, 0.45, 1);
}

}  // namespace enfilade::bench
