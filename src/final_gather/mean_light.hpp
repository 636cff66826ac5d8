// Means of the light over all polygons of a solution.
#pragma once

#include <span>

#include "hierarchy/cluster_state.hpp"

namespace enfilade {

/// Returns the mean irradiance per band, weighted by area; one zero where there is no cluster.
Spectrum mean_irradiance_over(std::span<const ClusterState> clusters);
/// Returns the mean radiosity of the largest band, weighted by area.
double mean_radiosity_over(std::span<const ClusterState> clusters);
/// Returns the mean radiosity over a node of the largest band.
double largest_radiosity(const PatchForest& forest, std::size_t node);

}  // namespace enfilade
