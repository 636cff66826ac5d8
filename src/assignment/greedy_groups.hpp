// [6]'s groups, with which §3.3.1 compares its own: grown greedily over a graph whose edges are
// weighted by estimated form factors.
#pragma once

#include <vector>

#include "assignment/assignment.hpp"

namespace enfilade {

/// As RR-3425 §2 describes [6] (Funkhouser, SIGGRAPH 96): clusters are nodes, an edge's value is
/// the estimated form factor of its two clusters, and the graph is split into groups. How a group
/// grows is our choice:
/// - Size: group g of P takes 1/(P-g) of the clusters that are left, rounded up, so that the sizes
///   of groups differ by one cluster at most.
/// - Start: the free cluster with the largest sum of weights to other free clusters. (Growing
///   inwards from the rim, or on from the last group, cut more edges of the buildings tried.)
/// - Next: the free cluster with the largest sum of weights to the group's members. Where no free
///   cluster has an edge to the group, a new start is chosen.
/// - Ties go to the lowest id; nothing is random, and no cluster is moved once it is placed.
/// Takes O((edges + nodes) log nodes + starts * nodes) time. Needs 1 <= parts <= nodes.
std::vector<Rank> greedy_groups(const ClusterGraph& graph, const FormFactorEstimate& weights,
                                int parts);

}  // namespace enfilade
