// The preparation of a run that several ranks solve: rank 0 prepares, all have the result.
#pragma once

#include <string>

#include "comm/communicator.hpp"
#include "run/prepare.hpp"

namespace enfilade {

/// Calls prepare_or_load() of run/prepare.hpp on rank 0; the other ranks then load the result from
/// RUN. All ranks call it. `warnings` become those of the scene, whenever it was prepared. `lock`
/// gets RUN locked: to write on rank 0, joined on the others.
Prepared prepare_on_root(Communicator& communicator, const SceneSource& read,
                         const std::string& run_directory, const PrepareConfig& config,
                         Warnings& warnings, const Progress& progress, bool resume, RunLock& lock);

}  // namespace enfilade
