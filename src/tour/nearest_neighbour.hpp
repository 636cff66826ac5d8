// Candidate lists, and the nearest-neighbour tour that improvement starts from.
#pragma once

#include <cstdint>
#include <vector>

#include "tour/tour.hpp"

namespace enfilade {

/// OVG's cheapest edges: for each of a rank's clusters the few clusters that are cheapest to go to,
/// and to come from. Clusters are named by their place in `clusters`; no n^2 matrix is ever made.
struct CandidateLists {
  std::size_t width = 0;                                  ///< most candidates a cluster has
  std::vector<std::vector<std::uint32_t>> after, before;  ///< cheapest first
};
CandidateLists candidate_lists(const std::vector<ClusterId>& clusters, const VisibilityCost& cost,
                               std::size_t width);

/// Returns a tour from `start`, always on to the cheapest candidate that is not yet visited; where
/// all candidates are visited, to the cheapest of a few clusters with close ids.
std::vector<std::uint32_t> nearest_neighbour_tour(const std::vector<ClusterId>& clusters,
                                                  const VisibilityCost& cost,
                                                  const CandidateLists& candidates,
                                                  std::uint32_t start);

}  // namespace enfilade
