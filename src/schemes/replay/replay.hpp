// A recorded run once more, on other computers: the SPMD loop with the recorded gathers in place of
// the kernels.
#pragma once

#include "schemes/solve/solve.hpp"

namespace enfilade {

/// All ranks call it, simulated ones: on a real machine the recorded work takes no time, so that is
/// refused (InputError). `recorded` is a RUN that was solved to its end. Of `config`, what shares
/// the work out counts (assignment, order, stealing, memory, seed), not what the light depends on:
/// iterations, their plans and their work are those of the run, so the numbers are true as long as
/// the iterations would be the same; with the coarse correction they are, on any ranks.
/// Returns the record of stats.json (on rank 0; elsewhere empty).
RunRecord replay(const std::string& recorded, const SolveConfig& config, Communicator& communicator,
                 Machine& machine, const IterationObserver& observer = {});

}  // namespace enfilade
