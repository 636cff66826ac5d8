// The replay of a recorded run on other computers: the SPMD loop with the recorded gathers in place
// of the kernels.
#pragma once

#include "schemes/solve/solve.hpp"

namespace enfilade {

/// All ranks call it. Throws InputError on a real machine, where recorded work takes no time, and
/// where `recorded` is no RUN that was solved to its end. Of `config`, the options that distribute
/// the work count (assignment, order, stealing, memory, seed); options that the light depends on do
/// not. The iterations, their plans and their work are those of the recorded run: the replay is
/// exact if the iterations would be the same, which the coarse correction ensures for any number of
/// ranks. Returns the record of stats.json on rank 0, elsewhere an empty one.
RunRecord replay(const std::string& recorded, const SolveConfig& config, Communicator& communicator,
                 Machine& machine, const IterationObserver& observer = {});

}  // namespace enfilade
