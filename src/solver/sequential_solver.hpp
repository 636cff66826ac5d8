// The solver as a library: a scene in, its light out, in one thread of one process, without files,
// messages or simulated machines. All parallel schemes are tested against it.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "occluders/occluders.hpp"
#include "preparation/preparation.hpp"
#include "solver/building_field.hpp"
#include "solver/gather_plan.hpp"
#include "solver/iteration_end.hpp"

namespace enfilade {

/// Returns 200,000 where at most 2% is asked for, and in inverse proportion to a larger target
/// error: who asks for less pays less.
std::uint64_t default_patch_links(double target_error);

struct SolverConfig {
  double target_error = 0.02;  ///< relative, area-weighted L1 of the irradiance
  double epsilon = 0.0;        ///< link tolerance over emitted power; 0 = from target_error
  double tolerance = 0.0;      ///< relative change to stop at; 0 = from target_error
  /// With more links than this, target_error does not apply to values read off patches; 0 = no
  /// limit; none: default_patch_links().
  std::optional<std::uint64_t> patch_links{};
  int max_iterations = 200;
  GatherSettings gather;
  IterationMethod method;
  Hierarchy hierarchy = Hierarchy::building;

  /// Values read off patches do not count where only the light at points does.
  std::uint64_t most_patch_links() const {
    if (!gather.target_points.empty()) return 1;
    return patch_links.value_or(default_patch_links(target_error));
  }
};

/// Returns the PlanConfig of a solve, from the solver's configuration and the scene's emitted
/// power.
PlanConfig plan_config(const SolverConfig& config, const Scene& scene,
                       std::span<const Cluster> clusters);

/// The light of a scene.
struct Solution {
  std::vector<ClusterState> clusters;  ///< in the order of their ids
  std::vector<IterationSummary> history;
  bool converged = false;  ///< the target error was reached
  ErrorEstimate error;     ///< the estimate after the last iteration
};

/// Gathers for the clusters in ascending order, iteration after iteration, until the plan ends.
/// `occluders`: of these clusters. final_gather/point_gather.hpp reads the light at a point.
Solution solve_sequentially(const Prepared& prepared, const Occluders& occluders,
                            const SolverConfig& config, const IterationObserver& observer = {});

}  // namespace enfilade
