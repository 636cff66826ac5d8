#include "parallel/solve.hpp"

#include <algorithm>
#include <chrono>

#include "base/error.hpp"
#include "parallel/history.hpp"
#include "parallel/radiosity_work.hpp"
#include "parallel/run_ranks.hpp"
#include "store/posix_file.hpp"

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

/// RUN/common as it is before the first iteration.
void start_anew(const RunLayout& layout, Communicator& communicator, RadiosityWork& work,
                std::span<const ClusterId> own) {
  communicator.on_root([&] {
    make_directory(layout.common());
    remove_manifest(layout);
    drop_costs(layout.run, -1);
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
      clusters_of(agree_on_owners(prepared, config, communicator), communicator.rank());
  const VisibilityCost cost = tour_cost(prepared, basis, memory);
  TaskList tasks(own, cost, config.order, config.seed);
  RadiosityWork work(
      prepared, layout, communicator.rank(), machine,
      {basis, config.max_depth, config.min_area_m2, memory, config.coarse_correction});
  work.set_next_use([&tasks](ClusterId id, bool links) { return tasks.next_use(id, links); });
  communicator.limit_message_bytes((std::size_t{1} << 16) + 4 * prepared.clusters.size() +
                                   8 * work.most_coarse_numbers());
  if (manifest) {
    communicator.on_root([&] { drop_costs(layout.run, manifest->iteration); });
  } else {
    start_anew(layout, communicator, work, own);
  }

  const Spectrum emitted = emitted_power(prepared.scene, prepared.clusters);
  const PlanConfig plan_config{.emitted_power = worst_band(emitted),
                               .epsilon = config.epsilon,
                               .tolerance = config.tolerance,
                               .target_error = config.target_error,
                               .max_iterations = config.max_iterations};
  std::vector<IterationSummary> history = history_of(manifest);
  const IterationPlan plan = next_plan(history, plan_config);
  const SpmdConfig spmd{config.steal, config.coarse_correction};
  RunRecord record = run_ranks(
      {.work = work,
       .tasks = tasks,
       .counts = [&] { return std::pair(work.store_count(), work.residency_count()); },
       .prepared = prepared,
       .basis = basis,
       .emitted = emitted,
       .spmd = spmd,
       .plan = plan,
       .changes = manifest ? manifest->correction : std::vector<double>{},
       .history = std::move(history)},
      communicator, machine,
      [&](const std::vector<IterationSummary>& so_far) { return next_plan(so_far, plan_config); },
      observer);
  if (communicator.root()) {
    record.set("solve_s", RunRecord::Value(seconds_of_wall() - wall_start_s));
    record.set("wall_s", RunRecord::Value(prepared.prepare_s + seconds_of_wall() - wall_start_s));
  }
  return record;
}

}  // namespace enfilade
