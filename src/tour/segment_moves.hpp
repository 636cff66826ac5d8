// Improves a tour by moving segments: Or-opt (short segments, either way round) and 3-opt segment
// exchange, which keeps the direction of travel and so suits asymmetric costs (Kanellakis and
// Papadimitriou 1980).
#pragma once

#include <cstdint>
#include <vector>

#include "tour/nearest_neighbour.hpp"

namespace enfilade {

struct SegmentMoveConfig {
  std::uint64_t costs_a_cluster = 1000;  ///< OVG edges that may be priced, for each cluster
  std::size_t longest_or_opt = 3;        ///< clusters in a segment that Or-opt moves
  int kicks_a_cluster = 4;  ///< random segment exchanges, kept where the tour gets cheaper
  std::uint64_t seed = 1;
};

/// `tour` holds places in `clusters`; so does the result, which never costs more.
std::vector<std::uint32_t> improve_tour(std::vector<std::uint32_t> tour,
                                        const std::vector<ClusterId>& clusters,
                                        const VisibilityCost& cost,
                                        const CandidateLists& candidates,
                                        const SegmentMoveConfig& config);

}  // namespace enfilade
