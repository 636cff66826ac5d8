// The phases of all ranks over time, collected on rank 0.
#pragma once

#include <vector>

#include "comm/communicator.hpp"
#include "machine/machine.hpp"
#include "machine/rank_profile.hpp"

namespace enfilade {

/// All ranks call it, after Machine::trace(). Returns the profiles by rank on rank 0, in bins of
/// one width; elsewhere an empty list.
std::vector<RankProfile> gather_profiles(Communicator& communicator, const Machine& machine);

}  // namespace enfilade
