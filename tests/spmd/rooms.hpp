// Scenes that the SPMD tests solve: two rooms joined by a door, a crate in one of them.
#pragma once

#include <vector>

#include "check.hpp"
#include "hierarchy/cluster_state.hpp"
#include "preparation/preparation.hpp"

namespace enfilade::spmd_tests {

constexpr double level = 3.0;  ///< irradiance everywhere in the furnace

/// Every surface sends out (1 - reflectance) level, so that E = B = level everywhere.
Scene furnace();
/// The same rooms, lit by a lamp below the ceiling of one of them; each side has a reflectance of
/// its own.
Scene lit_rooms();
/// A hall with 144 crates, each a cluster of its own, below four lamps.
Scene lit_hall();

/// The scene, prepared in RUN; with --resume, what is there stays. All ranks call it.
Prepared prepared_in(Context& context, const std::string& run, const Scene& scene);

/// All coefficients of the radiosity of all nodes of all clusters, in the order of their ids.
std::vector<double> all_radiosities(const std::vector<ClusterState>& clusters);
/// Mean radiosity of each cluster, in the order of their ids.
std::vector<double> mean_radiosities(const std::vector<ClusterState>& clusters);

}  // namespace enfilade::spmd_tests
