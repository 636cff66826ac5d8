// The tour's start: candidates to go to next, and the nearest-neighbour tour made of them.
#pragma once

#include <cstdint>
#include <vector>

#include "tour/tour.hpp"

namespace enfilade {

/// OVG restricted to what matters: for each of a rank's clusters the few cheapest to go to, and to
/// come from. Clusters are named by their place in `clusters`; no n^2 matrix is ever made.
struct CandidateLists {
  std::size_t width = 0;                                  ///< most candidates a cluster has
  std::vector<std::vector<std::uint32_t>> after, before;  ///< cheapest first
};
CandidateLists candidate_lists(const std::vector<ClusterId>& clusters, const VisibilityCost& cost,
                               std::size_t width);

/// From `start` always on to the cheapest cluster not yet visited; where all candidates are, to one
/// that is close by id.
std::vector<std::uint32_t> nearest_neighbour_tour(const std::vector<ClusterId>& clusters,
                                                  const VisibilityCost& cost,
                                                  const CandidateLists& candidates,
                                                  std::uint32_t start);

}  // namespace enfilade
