// G_cluster in its own file (§4.1): for each cluster the name of its file, its number, and the list
// of the clusters visible to it. Plain text, one cluster a line.
#pragma once

#include <string>

#include "visibility/cluster_graph.hpp"

namespace enfilade {

void write_graph(const ClusterGraph& graph, const std::string& path);
/// Throws RunError for a file that is missing or damaged.
ClusterGraph read_graph(const std::string& path);

}  // namespace enfilade
