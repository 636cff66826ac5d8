#include "solver/iteration_end.hpp"

#include <optional>

#include "solver/error_estimate.hpp"

namespace enfilade {

Correction correction_of(const CoarseSystem& system, const CoarseUnknowns& unknowns) {
  Correction correction;
  std::optional<std::vector<double>> changes = system.solve(unknowns);
  correction.failed = !changes;
  if (!changes) return correction;
  correction.changes = std::move(*changes);
  correction.missing_power = system.power(correction.changes);
  correction.absorbed_power = system.absorbed(correction.changes);
  correction.escaping_power = system.escaping(correction.changes);
  return correction;
}

IterationSummary summary_of(const IterationPlan& plan, IterationFigures figures,
                            const Correction* correction, double time_s) {
  IterationSummary summary;
  summary.plan = plan;
  summary.figures = std::move(figures);
  summary.time_s = time_s;
  if (correction == nullptr) return summary;
  summary.corrected = !correction->failed;
  summary.correction_failed = correction->failed;
  summary.missing_power = correction->missing_power;
  for (std::size_t b = 0; b < correction->absorbed_power.size(); ++b) {
    summary.figures.absorbed_power[b] += correction->absorbed_power[b];
    summary.figures.escaping_power[b] += correction->escaping_power[b];
  }
  return summary;
}

IterationPlan end_iteration(std::vector<IterationSummary>& history, const PlanConfig& config) {
  history.back().error = estimate_error(history, config.surfaces_power);
  return next_plan(history, config);
}

}  // namespace enfilade
