// Figure 1 of the paper: classification of K-means type on G_val.
#pragma once

#include <vector>

#include "assignment/assignment.hpp"

namespace enfilade {

/// Groups of G_val around centres of gravity. A node that is equally near to several centres goes
/// to the one of them that is still below its fair share of nodes and has most of the node's
/// neighbours: figure 1 leaves the choice open, and in a building, where hops are few, such nodes
/// are many. Figure 1 ends in a local optimum that depends on its random first centres, so that it
/// is run from `config.starts` choices of these: of the groupings that are even enough, the one
/// with the fewest cut edges is taken, otherwise the most even one. Needs 1 <= parts <= nodes.
std::vector<Rank> kmeans_groups(const ClusterGraph& graph, const AssignmentConfig& config);

/// Returns the most central element of each group: least sum, then least maximum of hops to the
/// group's members, then the lowest id. In groups of more than `max_pivots` members the hops to
/// that many members count, evenly spaced in the order of their ids.
std::vector<std::uint32_t> centres_of_gravity(const ClusterGraph& graph,
                                              const std::vector<Rank>& owner, std::size_t parts,
                                              std::size_t max_pivots);

}  // namespace enfilade
