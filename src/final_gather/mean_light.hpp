// Means of the light over all polygons of a solution.
#pragma once

#include <span>

#include "hierarchy/cluster_state.hpp"

namespace enfilade {

/// Returns the mean irradiance per band, weighted by area; one zero where there is no cluster.
Spectrum mean_irradiance_over(std::span<const ClusterState> clusters);
/// Returns the mean of PatchForest::link_error() over the leaves, weighted by the power that they
/// reflect, largest band.
double mean_link_error_over(std::span<const ClusterState> clusters);
/// Returns the mean radiosity of the largest band, weighted by area.
double mean_radiosity_over(std::span<const ClusterState> clusters);
/// Returns the mean radiosity over a node of the largest band.
double largest_radiosity(const PatchForest& forest, std::size_t node);

/// Returns how many times the light at a place (`light`, per band) goes into the mean: 1 or more.
/// Patches' errors are relative to the mean light, and weigh as many times as much there.
double darkness(const Spectrum& mean, std::span<const double> light);
/// Returns the distance from which a ray may read the light off the patch that it ends on, which is
/// an average over the patch, in sides of the square of its area: more where the patches' error is
/// larger, up to 4, since following the light on costs noise.
double far_sides(double patch_error);

}  // namespace enfilade
