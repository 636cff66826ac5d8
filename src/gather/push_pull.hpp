// Push-pull of what was gathered for one cluster, and the cluster's power balance.
#pragma once

#include <span>

#include "coarse/coarse_row.hpp"
#include "gather/gather.hpp"
#include "hierarchy/cluster_state.hpp"

namespace enfilade {

/// Pushes `gathered` (irradiance at every node, indexed like the light) to the leaves and pulls it
/// up; `config`: its `relaxation` and `extrapolation`. Sets the figures of change, received,
/// arriving, absorbed and escaping power, and the powers (not the entries) of the coarse row.
void push_pull(ClusterState& receiver, std::span<const double> gathered, const GatherConfig& config,
               IterationFigures& figures, CoarseRow& row);

}  // namespace enfilade
