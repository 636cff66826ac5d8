#include "schemes/solve/solve.hpp"

#include <algorithm>
#include <chrono>

#include "base/byte_stream.hpp"
#include "base/checksum.hpp"
#include "base/error.hpp"
#include "base/memory_wanted.hpp"
#include "base/posix_file.hpp"
#include "run/history.hpp"
#include "schemes/protocol/radiosity_work.hpp"
#include "schemes/solve/make_scheme.hpp"
#include "schemes/solve/run_ranks.hpp"

namespace enfilade {
namespace {

double seconds_of_wall() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Names the run in all its files: what it solves, and how. The same command gives the same name.
std::uint64_t name_of_run(const SolveConfig& config, const Prepared& prepared) {
  ByteWriter w;
  w.put(prepared.preparation);
  w.put(config.seed);
  w.put(config.target_error);
  w.put(config.epsilon);
  w.put(config.tolerance);
  w.put(config.most_patch_links());
  w.put(config.method.coarse_correction);
  w.put(config.method.jacobi);
  w.put(static_cast<int>(config.gather.basis));
  w.put(static_cast<int>(config.gather.oracle));
  w.put(static_cast<int>(config.gather.visibility));
  w.put(static_cast<int>(config.topmost()));
  w.put(static_cast<int>(config.scheme));
  w.put(config.relight.has_value());
  return checksum(w.bytes());
}

std::optional<Manifest> manifest_to_resume(const SolveConfig& config, const Prepared& prepared,
                                           const RunLayout& layout) {
  if (!config.resume) return std::nullopt;
  const std::optional<Manifest> manifest = read_manifest(layout);
  if (!manifest) return std::nullopt;  // killed before the first commit: begin anew
  if (manifest->clusters != prepared.clusters.size() ||
      manifest->scene_hash != prepared.scene.hash ||
      manifest->preparation != prepared.preparation) {
    throw InputError(config.run_directory, "--resume", "the solution there is of another scene",
                     "solve without --resume, or into another directory");
  }
  return manifest;
}

/// Leaves in RUN/common what the committed iteration needs: what an iteration that was not
/// committed has left, perhaps by ranks that are no more, would be taken for the next one's.
void clear_common(const RunLayout& layout, const std::optional<Manifest>& committed) {
  if (committed) {
    remove_later_segments(layout.common(), static_cast<std::uint32_t>(committed->iteration));
    return;
  }
  remove_manifest(layout);
  remove_directory(layout.common());
  make_directory(layout.common());
}

/// Writes RUN/common as it is before the first iteration. Each rank makes the files of the clusters
/// that it is assigned, and keeps those clusters in memory where it is going to gather for them.
void start_anew(const SchemeParts& p, const ParallelScheme& scheme, Basis basis,
                RadiosityWork& work, CostRecorder& recorder) {
  const Prepared& prepared = p.prepared;
  p.communicator.on_root([&] { drop_costs(p.store.layout().run, -1); });
  WorkCount count;
  const InitialClusters initial(prepared.scene, prepared.clusters, work.occluders(),
                                work.unknowns(), basis, count);
  p.machine.compute(count);
  std::optional<RelitClusters> relit;
  if (p.config.relight) relit.emplace(*p.config.relight, prepared);
  for (const ClusterId id : p.own) {
    ClusterState state = initial.make(id);
    if (relit) state = relit->make(std::move(state));
    p.store.write_initial(state);
    recorder.add_start(state);
    if (scheme.gathers_for_its_own()) work.adopt(std::move(state));
  }
  p.store.end_initial();
  recorder.write(0);
  p.communicator.barrier();
  p.communicator.on_root([&] { work.commit({}, {}, false); });
  if (relit) work.restore_far_light(0);
}

}  // namespace

std::vector<Rank> assign_clusters(const Prepared& prepared, const SolveConfig& config, int ranks) {
  return assign_clusters(prepared.graph, prepared.clusters,
                         {.method = config.assignment, .parts = ranks, .seed = config.seed});
}

bool is_solved(const SolveConfig& config, const Prepared& prepared, Communicator& communicator) {
  std::string solved;
  communicator.on_root([&] {
    const std::optional<Manifest> manifest =
        manifest_to_resume(config, prepared, RunLayout(config.run_directory));
    if (!manifest || !manifest->finished) return;
    const PlanConfig planning = plan_config(config, prepared.scene, prepared.clusters);
    if (next_plan(history_of(manifest), planning).finished) solved = "solved";
  });
  return !communicator.broadcast(solved).empty();
}

RunRecord solve(const SolveConfig& config, const Prepared& prepared, Communicator& communicator,
                Machine& machine, const IterationObserver& observer) {
  const MemoryPurpose purpose("the clusters, their patches and links");
  const double wall_start_s = seconds_of_wall();
  const RunLayout layout(config.run_directory, config.local_directory);
  const std::uint64_t memory =
      config.memory_bytes > 0 ? config.memory_bytes : machine.memory_bytes();
  const std::optional<Manifest> manifest = manifest_to_resume(config, prepared, layout);
  const Basis basis =
      manifest ? manifest->basis : config.gather.basis;  // a resumed solution keeps its basis

  communicator.on_root([&] { clear_common(layout, manifest); });  // before the others go on
  const std::vector<ClusterId> own =
      clusters_of(agree_on_owners(prepared, config, communicator), communicator.rank());
  const VisibilityCost cost = tour_cost(prepared, basis, memory);
  const std::uint64_t run = manifest ? manifest->run : name_of_run(config, prepared);
  // Local directories of ranks of earlier runs, which may have been more than these.
  communicator.on_root([&] { remove_directory(layout.local); });
  const int ranks = std::max(communicator.size(), manifest ? manifest->ranks : 0);
  ClusterStore store(layout, run, communicator.rank(), ranks, prepared.clusters.size(), machine);
  const SchemeParts parts{config, prepared, own, cost, store, communicator, machine};
  const std::unique_ptr<ParallelScheme> scheme = make_scheme(parts);
  CostRecorder recorder(layout.run, run, communicator.rank(), config.method);
  GatherSettings gather = config.gather;
  gather.basis = basis;
  const Hierarchy hierarchy = manifest ? manifest->hierarchy : config.topmost();
  RadiosityWork work(prepared, layout, scheme->files(), machine, &recorder,
                     {gather, config.method, hierarchy, memory, config.memory_manager, run, ranks});
  if (manifest) {
    communicator.on_root([&] { drop_costs(layout.run, manifest->iteration); });
    if (manifest->iteration > 0) work.restore_far_light(manifest->iteration);
  } else {
    start_anew(parts, *scheme, basis, work, recorder);
  }

  const PlanConfig planning = plan_config(config, prepared.scene, prepared.clusters);
  std::vector<IterationSummary> history = history_of(manifest);
  const IterationPlan plan = next_plan(history, planning);
  const IterationRun iterate_all = [&](std::vector<IterationSummary>& so_far) {
    return scheme->run(
        work, plan, manifest ? manifest->correction : std::vector<double>{}, so_far,
        [&](std::vector<IterationSummary>& done) { return end_iteration(done, planning); },
        observer);
  };
  RunRecord record = run_ranks({prepared, basis, planning.emitted_power, std::move(history),
                                [&] { return std::pair(store.count(), work.residency_count()); }},
                               communicator, machine, iterate_all);
  if (communicator.root()) {
    record.set("oracle", config.gather.oracle == OracleKind::error ? "error" : "bf");
    record.set("visibility",
               config.gather.visibility == VisibilityMethod::exact ? "exact" : "rays");
    record.set("solve_s", RunRecord::Value(seconds_of_wall() - wall_start_s));
    record.set("wall_s", RunRecord::Value(prepared.prepare_s + seconds_of_wall() - wall_start_s));
  }
  return record;
}

}  // namespace enfilade
