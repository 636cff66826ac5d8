// The power that a scene emits: errors and tolerances are relative to it.
#pragma once

#include <span>

#include "hierarchy/cluster_state.hpp"

namespace enfilade {

/// Returns the power per band that the clusters' surfaces and all lights of the scene emit: area
/// times exitance, and 4 pi times intensity.
Spectrum emitted_power(const Scene& scene, std::span<const Cluster> clusters);

}  // namespace enfilade
