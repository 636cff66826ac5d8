// A second-order iterative method for what the coarse correction leaves: how the light lies within
// each aggregate, as in gaps and corners, whose sides exchange most of their light with each other.
#pragma once

#include <span>
#include <vector>

#include "hierarchy/cluster_state.hpp"

namespace enfilade {

/// Returns the power that arrives at the leaves: [aggregate * bands + band].
std::vector<double> arriving_power(const ClusterState& receiver);

/// Moves each leaf's irradiance to `extrapolation` times its distance from `earlier`, the light two
/// iterations before (PatchForest::take_kept_light(); nothing is done where that is empty), scaled
/// to the power that each aggregate has now. With an extrapolation of 2 / (1 + sqrt(1 - s^2)) all
/// errors that an iteration multiplies by at most s are multiplied by s / (1 + sqrt(1 - s^2))
/// (second-order Richardson or Chebyshev semi-iteration; Golub and Varga 1961). The aggregates'
/// powers hardly change; leaves whose light has changed by more than a tenth stay as they are.
void extrapolate(ClusterState& receiver, std::span<const double> earlier, double extrapolation);

}  // namespace enfilade
