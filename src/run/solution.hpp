// The solution that a RUN directory holds.
#pragma once

#include <string>
#include <vector>

#include "hierarchy/cluster_state.hpp"
#include "run/manifest.hpp"
#include "run/run_layout.hpp"

namespace enfilade {

/// Returns all clusters of the last committed iteration, in order of their ids, after its coarse
/// correction; with their links if `links`. Throws InputError where RUN holds no solution,
/// RunError for a file that is damaged or of another run.
std::vector<ClusterState> read_solution(const std::string& run_directory, bool links = false);
/// The same of one cluster. `manifest`: of this RUN.
ClusterState read_cluster(const RunLayout& layout, const Manifest& manifest, ClusterId id,
                          bool links);

}  // namespace enfilade
