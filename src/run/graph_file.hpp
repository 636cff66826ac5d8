// G_cluster in its own file (§4.1): plain text, one line for each cluster, with the stem of its
// files, its number, and the numbers of the clusters visible to it.
#pragma once

#include <string>

#include "visibility/cluster_graph.hpp"

namespace enfilade {

void write_graph(const ClusterGraph& graph, const std::string& path);
/// Throws RunError for a file that is missing or damaged.
ClusterGraph read_graph(const std::string& path);

}  // namespace enfilade
