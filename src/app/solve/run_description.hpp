// Which program, scene and settings a run record comes from, so that it can be made again.
#pragma once

#include "base/run_record.hpp"
#include "run/prepare.hpp"
#include "schemes/solve/solve.hpp"

namespace enfilade {

/// Adds version, revision, scene_hash, seed, target_error and the strategies to a record.
void describe_run(RunRecord& record, const SolveConfig& config, const Prepared& prepared);
/// The subset of these that does not depend on the scene.
void describe_strategies(RunRecord& record, const SolveConfig& config);

}  // namespace enfilade
