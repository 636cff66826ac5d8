#include "schemes/solve/solve.hpp"

#include <algorithm>
#include <chrono>

#include "base/error.hpp"
#include "base/posix_file.hpp"
#include "gather/emitted_power.hpp"
#include "occluders/unreachable_polygons.hpp"
#include "run/history.hpp"
#include "schemes/master/cell_dealer.hpp"
#include "schemes/master/dealing.hpp"
#include "schemes/master/group_dealer.hpp"
#include "schemes/protocol/radiosity_work.hpp"
#include "schemes/solve/run_ranks.hpp"
#include "schemes/spmd/spmd.hpp"
#include "solver/energy_conservation.hpp"
#include "solver/error_estimate.hpp"

namespace enfilade {
namespace {

double seconds_of_wall() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::optional<Manifest> manifest_to_resume(const SolveConfig& config, const Prepared& prepared,
                                           const RunLayout& layout) {
  if (!config.resume) return std::nullopt;
  const std::optional<Manifest> manifest = read_manifest(layout);
  if (!manifest) return std::nullopt;  // died before anything was committed: begin at the beginning
  if (manifest->clusters != prepared.clusters.size() ||
      manifest->scene_hash != prepared.scene.hash) {
    throw InputError(config.run_directory, "--resume", "the solution there is of another scene",
                     "solve without --resume, or into another directory");
  }
  return manifest;
}

/// RUN/common as it is before the first iteration; each rank makes its own clusters' files, and
/// keeps them in memory where it is going to gather for them.
void start_anew(const Prepared& prepared, Basis basis, ClusterStore& store,
                Communicator& communicator, RadiosityWork& work, CostRecorder& recorder,
                std::span<const ClusterId> own, Machine& machine, bool keep) {
  communicator.on_root([&] {
    make_directory(store.layout().common());
    remove_manifest(store.layout());
    drop_costs(store.layout().run, -1);
  });
  WorkCount count;
  const std::vector<char> dark =
      unreachable_polygons(prepared.scene, prepared.clusters, work.occluders(), count);
  machine.compute(count);
  for (const ClusterId id : own) {
    ClusterState state(prepared.clusters[id.index()], prepared.scene, basis,
                       work.unknowns().aggregates[id.index()]);
    for (std::uint32_t k = 0; k < state.patches().polygons(); ++k) {
      if (dark[work.occluders().global(id, k)] != 0) state.patches().mark_unreachable(k);
    }
    store.write_initial(state);
    recorder.add_start(state);
    if (keep) work.adopt(std::move(state));
  }
  recorder.write(0);
  communicator.barrier();
  communicator.on_root([&] { work.commit({}, {}, false); });
}

/// All that the loop of a scheme runs on.
struct Solver {
  const SolveConfig& config;
  const Prepared& prepared;
  Communicator& communicator;
  Machine& machine;
  const VisibilityCost& cost;
  ClusterStore& store;
  RemoteFiles& remote;
  RadiosityWork& work;

  std::unique_ptr<Order> order() const {
    return make_order(config.order, config.seed, prepared.graph, emitted_powers(prepared));
  }
  int slaves() const { return communicator.size() - 1; }
  std::unique_ptr<Dealer> dealer() const {
    if (config.scheme == Scheme::master_slave)
      return std::make_unique<GroupDealer>(prepared, slaves(), *order(), cost, config.steal);
    return std::make_unique<CellDealer>(prepared, slaves(), emitted_powers(prepared), config.seed,
                                        config.steal);
  }
};

/// A rank that is alone has nobody to be the master of.
bool has_master(const SolveConfig& config, const Communicator& communicator) {
  return config.scheme != Scheme::spmd && communicator.size() > 1;
}

IterationPlan iterate(const Solver& s, std::span<const ClusterId> own, const IterationPlan& plan,
                      const std::vector<double>& changes, std::vector<IterationSummary>& history,
                      const PlanNext& plan_next, const IterationObserver& observer) {
  const bool correction = s.config.coarse_correction;
  if (!has_master(s.config, s.communicator)) {
    TaskList tasks({own.begin(), own.end()}, s.cost, s.order());
    s.work.set_next_use([&tasks](ClusterId id, bool links) { return tasks.next_use(id, links); });
    return run_spmd(s.work, tasks, s.communicator, s.machine, {s.config.steal, correction}, plan,
                    changes, history, plan_next, observer);
  }
  if (!s.communicator.root())
    return run_slave(s.work, s.remote, s.communicator, s.machine, correction, plan, changes);
  ConvergenceMonitor monitor(s.work, s.machine, correction, history, plan_next, observer);
  const std::unique_ptr<Dealer> dealer = s.dealer();
  return Master(s.work, s.store, *dealer, s.communicator, s.machine, monitor, correction)
      .run(plan, changes);
}

}  // namespace

std::vector<Rank> assign_clusters(const Prepared& prepared, const SolveConfig& config, int ranks) {
  return assign(prepared.graph, FormFactorEstimate(prepared.clusters),
                {.method = config.assignment, .parts = ranks, .seed = config.seed});
}

RunRecord solve(const SolveConfig& config, const Prepared& prepared, Communicator& communicator,
                Machine& machine, const IterationObserver& observer) {
  const double wall_start_s = seconds_of_wall();
  const RunLayout layout(config.run_directory, config.local_directory);
  const std::uint64_t memory =
      config.memory_bytes > 0 ? config.memory_bytes : machine.memory_bytes();
  const std::optional<Manifest> manifest = manifest_to_resume(config, prepared, layout);
  const Basis basis =
      manifest ? manifest->basis : config.basis;  // a solution keeps the basis it has

  const std::vector<ClusterId> own =
      clusters_of(agree_on_owners(prepared, config, communicator), communicator.rank());
  const VisibilityCost cost = tour_cost(prepared, basis, memory);
  ClusterStore store(layout, communicator.rank(), prepared.clusters.size(), machine);
  RemoteFiles remote(communicator, machine);
  const bool slave = has_master(config, communicator) && !communicator.root();
  const IterationMethod light{config.coarse_correction, config.jacobi};
  CostRecorder recorder(layout.run, communicator.rank(), light);
  RadiosityWork work(prepared, layout, slave ? static_cast<ClusterFiles&>(remote) : store, machine,
                     recorder,
                     {basis, config.max_depth, config.min_area_m2, memory, light,
                      config.memory_manager, config.oracle, config.visibility});
  if (manifest) {
    communicator.on_root([&] { drop_costs(layout.run, manifest->iteration); });
  } else {
    start_anew(prepared, basis, store, communicator, work, recorder, own, machine,
               !has_master(config, communicator));
  }

  const Spectrum emitted = emitted_power(prepared.scene, prepared.clusters);
  const PlanConfig plan_config{.emitted_power = emitted,
                               .surfaces_power = surfaces_power(prepared.scene, emitted),
                               .epsilon = config.epsilon,
                               .tolerance = config.tolerance,
                               .target_error = config.target_error,
                               .patch_links = config.patch_links,
                               .max_iterations = config.max_iterations};
  std::vector<IterationSummary> history = history_of(manifest);
  const IterationPlan plan = next_plan(history, plan_config);
  const IterationRun iterate_all = [&](std::vector<IterationSummary>& so_far) {
    return iterate(
        {config, prepared, communicator, machine, cost, store, remote, work}, own, plan,
        manifest ? manifest->correction : std::vector<double>{}, so_far,
        [&](std::vector<IterationSummary>& done) {
          done.back().error = estimate_error(done, plan_config.surfaces_power);
          return next_plan(done, plan_config);
        },
        observer);
  };
  RunRecord record = run_ranks({prepared, basis, emitted, std::move(history),
                                [&] { return std::pair(store.count(), work.residency_count()); }},
                               communicator, machine, iterate_all);
  if (communicator.root()) {
    record.set("oracle", config.oracle == OracleKind::error ? "error" : "bf");
    record.set("visibility", config.visibility == VisibilityMethod::exact ? "exact" : "rays");
    record.set("solve_s", RunRecord::Value(seconds_of_wall() - wall_start_s));
    record.set("wall_s", RunRecord::Value(prepared.prepare_s + seconds_of_wall() - wall_start_s));
  }
  return record;
}

}  // namespace enfilade
