// What a link means to the coarse system.
#pragma once

#include <span>

#include "radiosity/cluster_state.hpp"

namespace enfilade {

/// Area times form factor (m2) from the shooter as a whole: what its mean radiosity brings in
/// power.
double area_factor(const PatchForest& receiver, const Link& link, std::span<const float> transport);

/// Mean exitance of a shooting node in a band: what it gives of its own, not by reflection.
double mean_exitance(const PatchForest& shooter, PatchId node, std::size_t band);

}  // namespace enfilade
