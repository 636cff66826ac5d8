#include "parallel/solve.hpp"

#include <algorithm>
#include <chrono>
#include <limits>

#include "base/error.hpp"
#include "parallel/history.hpp"
#include "parallel/radiosity_work.hpp"
#include "parallel/run_statistics.hpp"
#include "parallel/spmd.hpp"
#include "store/posix_file.hpp"

namespace enfilade {
namespace {

double seconds_of_wall() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::vector<ClusterId> own_clusters(const Prepared& prepared, const SolveConfig& config, Rank rank,
                                    int ranks) {
  const std::vector<Rank> owner = assign_clusters(prepared, config, ranks);
  std::vector<ClusterId> own;
  for (std::size_t i = 0; i < owner.size(); ++i) {
    if (owner[i] == rank) own.emplace_back(i);
  }
  return own;
}

/// Bytes of a cluster as it comes from the disk for the first time, near enough to order a tour by.
std::vector<std::uint64_t> expected_bytes(const Prepared& prepared, Basis basis) {
  std::vector<std::uint64_t> bytes;
  const auto values =
      static_cast<std::uint64_t>(prepared.scene.bands) * static_cast<std::uint64_t>(basis);
  for (const Cluster& cluster : prepared.clusters) {
    bytes.push_back(256 + cluster.polygons.size() * (320 + 16 * values));
  }
  return bytes;
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

/// RUN/common as it is before the first iteration.
void start_anew(const RunLayout& layout, Communicator& communicator, RadiosityWork& work,
                std::span<const ClusterId> own) {
  communicator.on_root([&] {
    make_directory(layout.common());
    remove_manifest(layout);
  });
  work.initialise(own);
  communicator.barrier();
  communicator.on_root([&] { work.commit({}, {}, false); });
}

double worst_band(const Spectrum& power) {
  return power.empty() ? 0.0 : *std::max_element(power.begin(), power.end());
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
      own_clusters(prepared, config, communicator.rank(), communicator.size());
  const VisibilityCost cost(prepared.graph, expected_bytes(prepared, basis),
                            memory > 0 ? memory : std::numeric_limits<std::uint64_t>::max());
  TaskList tasks(own, cost, config.order, config.seed);
  RadiosityWork work(prepared, layout, communicator.rank(), machine,
                     {basis, config.max_depth, config.min_area_m2, memory, config.coarse_correction,
                      config.oracle, config.visibility});
  work.set_next_use([&tasks](ClusterId id, bool links) { return tasks.next_use(id, links); });
  communicator.limit_message_bytes((std::size_t{1} << 16) + 4 * prepared.clusters.size() +
                                   8 * work.most_coarse_numbers());
  if (!manifest) start_anew(layout, communicator, work, own);

  const Spectrum emitted = emitted_power(prepared.scene, prepared.clusters);
  const PlanConfig plan_config{.emitted_power = worst_band(emitted),
                               .epsilon = config.epsilon,
                               .tolerance = config.tolerance,
                               .target_error = config.target_error,
                               .max_iterations = config.max_iterations};
  std::vector<IterationSummary> history = history_of(manifest);
  const IterationPlan plan = next_plan(history, plan_config);
  communicator.barrier();

  const double start_s = machine.now_s();
  const TimeUse before = machine.time_use();
  const IterationPlan last = run_spmd(
      work, tasks, communicator, machine, {config.steal, config.coarse_correction}, plan,
      manifest ? manifest->correction : std::vector<double>{}, history,
      [&](const std::vector<IterationSummary>& so_far) { return next_plan(so_far, plan_config); },
      observer);

  const TimeUse after = machine.time_use();
  const RankStatistics mine{
      {after.compute_s - before.compute_s, after.io_s - before.io_s, after.idle_s - before.idle_s},
      machine.now_s() - start_s,
      work.store_count(),
      work.residency_count(),
      communicator.sent()};
  RunRecord record =
      gather_statistics(prepared, basis, emitted, history, last, mine, communicator, machine);
  if (communicator.root()) {
    record.set("oracle", config.oracle == OracleKind::error ? "error" : "bf");
    record.set("visibility", config.visibility == VisibilityMethod::shafts ? "shafts" : "rays");
    record.set("solve_s", RunRecord::Value(seconds_of_wall() - wall_start_s));
    record.set("wall_s", RunRecord::Value(prepared.prepare_s + seconds_of_wall() - wall_start_s));
  }
  return record;
}

}  // namespace enfilade
