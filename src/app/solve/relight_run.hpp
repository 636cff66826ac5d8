// solve RUN --relight SCENE: which of a run's links stand for another scene, and where they do not.
#pragma once

#include "app/solve/solve_options.hpp"
#include "base/run_record.hpp"
#include "base/warnings.hpp"
#include "comm/communicator.hpp"

namespace enfilade {

/// Throws InputError that names the first surface of `now` (its file is `now.file`) whose geometry
/// is not that of `before`, or whose place before or behind another in its plane changes since the
/// one that emits is in front. `run`: of `before`, for the message.
void check_same_geometry(const Scene& now, const Scene& before, const std::string& run);

/// Reads the scene of --relight, checks it against the RUN given, and prepares the RUN to fill for
/// it. Fills in what the solve takes over from that RUN: config.relight, basis, hierarchy, link
/// tolerance, and the target error unless it is given. All ranks call it. Throws InputError.
Prepared begin_relight(const SolveOptions& options, SolveConfig& config, Communicator& communicator,
                       Warnings& warnings, RunLock& lock);

/// Returns a warning with the remedy where the target error is missed: links were refined for other
/// light. `record`: of stats.json.
Warnings relight_shortfall(const SolveOptions& options, const RunRecord& record);

}  // namespace enfilade
