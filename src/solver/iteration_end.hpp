// The end of an iteration: its coarse correction, its summary, and the plan that follows.
#pragma once

#include <vector>

#include "coarse/coarse_system.hpp"
#include "solver/iteration_plan.hpp"

namespace enfilade {

/// The change of every cluster's light by the coarse correction, before the next iteration.
struct Correction {
  std::vector<double> changes;  ///< relative, [unknown * bands + band]; empty = none
  bool failed = false;          ///< the coarse system has no finite solution: there are no changes
  /// Power of the changes: the remaining power, estimated by the correction.
  double missing_power = 0.0;
  /// Per band: the correction's part of IterationFigures::absorbed_power and escaping_power.
  Spectrum absorbed_power, escaping_power;
};

/// Solves the coarse system of an iteration.
Correction correction_of(const CoarseSystem& system, const CoarseUnknowns& unknowns);

/// Returns the summary of an iteration, without its error. `correction` is null where there is no
/// coarse correction.
IterationSummary summary_of(const IterationPlan& plan, IterationFigures figures,
                            const Correction* correction, double time_s);

/// Estimates the error of the last iteration of `history`, and returns the plan of the next.
IterationPlan end_iteration(std::vector<IterationSummary>& history, const PlanConfig& config);

}  // namespace enfilade
