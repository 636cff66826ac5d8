// The preparation of a run that several ranks solve: rank 0 prepares, all have the result.
#pragma once

#include <string>

#include "comm/communicator.hpp"
#include "run/prepare.hpp"

namespace enfilade {

/// Rank 0 does what prepare_or_load() of run/prepare.hpp does; then every rank has the result, the
/// others from RUN. All ranks call it. `warnings` become those of the scene, whenever it was
/// prepared.
Prepared prepare_on_root(Communicator& communicator, const SceneSource& read,
                         const std::string& run_directory, const PrepareConfig& config,
                         Warnings& warnings, const Progress& progress = {}, bool resume = false);

}  // namespace enfilade
