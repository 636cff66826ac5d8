// A solution for each luminaire, or each group of them, over the links of a finished solve, on all
// ranks.
#pragma once

#include "base/progress.hpp"
#include "comm/communicator.hpp"
#include "machine/machine.hpp"
#include "run/light_shares.hpp"
#include "schemes/solve/solve.hpp"

namespace enfilade {

/// Finds the share of each group of share_groups() and writes RUN/shares. Links, their transport,
/// the rows' closure and the flux correction stay as the solution of RUN has them; over these,
/// light is linear, and all shares are gathered together, each as further bands beside the whole
/// light, which stays as it is. No ray is cast and no link is evaluated. All ranks call it once RUN
/// is solved, with the same arguments; the scheme is the paper's. The result is the same on any
/// number of ranks. `prepared` is the same afterwards. Returns the index on rank 0. Throws
/// InputError where RUN has no solution or its scene no light.
ShareIndex solve_shares(const SolveConfig& config, Prepared& prepared, Communicator& communicator,
                        Machine& machine, const Progress& progress);

}  // namespace enfilade
