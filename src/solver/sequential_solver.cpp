#include "solver/sequential_solver.hpp"

#include <algorithm>
#include <chrono>
#include <optional>

#include "gather/emitted_power.hpp"
#include "gather/gather.hpp"
#include "solver/energy_conservation.hpp"
#include "solver/importance.hpp"

namespace enfilade {
namespace {

using Clock = std::chrono::steady_clock;

/// One solve; see solve_sequentially().
class Solver {
 public:
  Solver(const Prepared& prepared, const Occluders& occluders, const SolverConfig& config)
      : prepared_(prepared),
        occluders_(occluders),
        config_(config),
        plan_config_(plan_config(config, prepared.scene, prepared.clusters)),
        unknowns_(config.method.unknowns(prepared.clusters)),
        field_(prepared, unknowns_, config.hierarchy),
        bands_(static_cast<std::size_t>(prepared.scene.bands)) {
    WorkCount work;
    const InitialClusters initial(prepared.scene, prepared.clusters, occluders, unknowns_,
                                  config.gather.basis, work);
    importance_ = importance_to(config.gather.target_points, prepared.scene, prepared.clusters,
                                occluders, work);
    for (std::size_t i = 0; i < prepared.clusters.size(); ++i) {
      solution_.clusters.push_back(initial.make(ClusterId(i)));
      area_m2_ += prepared.clusters[i].area_m2;
    }
  }

  Solution run(const IterationObserver& observer) {
    IterationPlan plan = first_plan(plan_config_);
    while (!plan.finished) {
      plan = iterate(plan);
      if (observer) observer(solution_.history.back());
    }
    solution_.converged = plan.converged;
    if (!solution_.history.empty()) solution_.error = solution_.history.back().error;
    return std::move(solution_);
  }

 private:
  /// Runs one iteration, with its coarse correction, and returns the plan of the next.
  IterationPlan iterate(const IterationPlan& plan);
  GatherResult gather(ClusterState& receiver, std::span<const ClusterState> light,
                      const GatherConfig& config, CoarseSystem& coarse);
  void correct(const Correction& correction) {
    for (ClusterState& state : solution_.clusters) {
      state.correct(unknowns_.of(state.id(), correction.changes, bands_));
    }
  }
  double time_s() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  const Prepared& prepared_;
  const Occluders& occluders_;
  const SolverConfig& config_;
  PlanConfig plan_config_;
  CoarseUnknowns unknowns_;
  BuildingField field_;
  std::size_t bands_;
  double area_m2_ = 0.0;
  std::vector<float> importance_;
  Solution solution_;
  Clock::time_point start_ = Clock::now();
};

GatherResult Solver::gather(ClusterState& receiver, std::span<const ClusterState> light,
                            const GatherConfig& config, CoarseSystem& coarse) {
  std::vector<ClusterId> listed;
  GatherResult result = enfilade::gather(
      receiver, field_.shooters(receiver.id(), listed),
      [light](ClusterId id) -> const ClusterState& { return light[id.index()]; },
      prepared_.scene.lights, occluders_, config);
  if (config.coarse_row) coarse.add(receiver.id(), result.coarse, unknowns_);
  return result;
}

IterationPlan Solver::iterate(const IterationPlan& plan) {
  const GatherConfig config =
      gather_config(plan, config_.gather, config_.method, area_m2_, importance_);
  std::vector<ClusterState> committed;
  const bool jacobi = config_.method.uses_jacobi(plan, unknowns_);
  if (jacobi) {
    for (const ClusterState& state : solution_.clusters) committed.push_back(state.shooter());
  }
  CoarseSystem coarse(unknowns_.count, bands_);
  IterationFigures figures;
  std::vector<ClusterLight> lights;
  for (ClusterState& receiver : solution_.clusters) {
    GatherResult result = gather(receiver, jacobi ? committed : solution_.clusters, config, coarse);
    add(figures, result.figures);
    lights.push_back(std::move(result.light));
  }
  std::optional<Correction> correction;
  if (config_.method.coarse_correction) {
    correction = correction_of(coarse, unknowns_);
    if (!correction->failed) correct(*correction);
  }
  if (field_.has_tree()) {
    for (const ClusterState& state : solution_.clusters) {
      field_.set(state.id(), lights[state.id().index()]);
    }
  }
  field_.end_iteration(correction ? correction->changes : std::vector<double>{});
  solution_.history.push_back(
      summary_of(plan, std::move(figures), correction ? &*correction : nullptr, time_s()));
  return end_iteration(solution_.history, plan_config_);
}

}  // namespace

std::uint64_t default_patch_links(double target_error) {
  constexpr double links = 200000.0, at_error = 0.02;
  return static_cast<std::uint64_t>(links * std::min(1.0, at_error / target_error));
}

PlanConfig plan_config(const SolverConfig& config, const Scene& scene,
                       std::span<const Cluster> clusters) {
  const Spectrum emitted = emitted_power(scene, clusters);
  PlanConfig plan;
  plan.emitted_power = emitted;
  plan.surfaces_power = surfaces_power(scene, emitted);
  plan.epsilon = config.epsilon;
  plan.tolerance = config.tolerance;
  plan.target_error = config.target_error;
  plan.clusters = clusters.size();
  plan.patch_links = config.most_patch_links();
  plan.max_iterations = config.max_iterations;
  plan.at_points = !config.gather.target_points.empty();
  return plan;
}

Solution solve_sequentially(const Prepared& prepared, const Occluders& occluders,
                            const SolverConfig& config, const IterationObserver& observer) {
  return Solver(prepared, occluders, config).run(observer);
}

}  // namespace enfilade
