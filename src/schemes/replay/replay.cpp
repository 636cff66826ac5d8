#include "schemes/replay/replay.hpp"

#include <map>

#include "base/error.hpp"
#include "gather/emitted_power.hpp"
#include "schemes/replay/replay_work.hpp"
#include "schemes/solve/run_ranks.hpp"
#include "schemes/spmd/spmd.hpp"

namespace enfilade {
namespace {

ReplayShared load(const std::string& recorded) {
  ReplayShared shared;
  shared.prepared = load_prepared(recorded);
  shared.recording = read_recording(recorded, shared.prepared.clusters.size());
  shared.unknowns = shared.recording.method.unknowns(shared.prepared.clusters);
  for (const auto& gathers : shared.recording.gathers) {
    for (const GatherCost& cost : gathers) {
      cost.coupled.for_each([&](std::uint32_t place) {
        if (place / shared.unknowns.count < shared.unknowns.aggregates[cost.cluster.index()])
          return;
        throw InputError(recorded, "costs", "damaged", "solve it again, then replay it");
      });
    }
  }
  shared.emitted = emitted_power(shared.prepared.scene, shared.prepared.clusters);
  shared.emitted_powers = emitted_powers(shared.prepared);
  return shared;
}

/// OVG's costs, by the size of a rank's memory.
using Costs = std::map<std::uint64_t, VisibilityCost>;
Costs costs_of(const Prepared& prepared, Basis basis,
               const std::vector<std::vector<double>>& memories) {
  Costs costs;
  for (const auto& rank : memories) {
    const auto memory = static_cast<std::uint64_t>(rank.front());
    if (!costs.contains(memory)) costs.emplace(memory, tour_cost(prepared, basis, memory));
  }
  return costs;
}

}  // namespace

RunRecord replay(const std::string& recorded, const SolveConfig& config, Communicator& communicator,
                 Machine& machine, const IterationObserver& observer) {
  communicator.on_root([&] {
    if (!machine.time_passes_by_itself()) return;
    throw InputError("command line", "--replay",
                     "the recorded work takes no time on a real machine",
                     "run enfilade-smpi under smpirun");
  });
  const auto shared = share<ReplayShared>(communicator, [&recorded] { return load(recorded); });
  const Prepared& prepared = shared->prepared;
  const Recording& recording = shared->recording;
  const std::uint64_t memory =
      config.memory_bytes > 0 ? config.memory_bytes : machine.memory_bytes();
  const std::vector<double> mine{static_cast<double>(memory)};
  const auto memories = communicator.gather(mine);
  const auto costs =
      share<Costs>(communicator, [&] { return costs_of(prepared, recording.basis, memories); });

  const std::vector<ClusterId> own =
      clusters_of(agree_on_owners(prepared, config, communicator), communicator.rank());
  TaskList tasks(own, costs->at(memory),
                 make_order(config.order, config.seed, prepared.graph, shared->emitted_powers));
  ReplayWork work(shared, machine, memory, config.memory_manager);
  work.set_next_use([&tasks](ClusterId id, bool links) { return tasks.next_use(id, links); });
  work.initialise(own);
  const auto plan_of = [&recording](std::size_t iteration) {  // counted from 0
    if (iteration < recording.history.size()) return recording.history[iteration].plan;
    IterationPlan plan;
    plan.finished = plan.converged = true;
    return plan;
  };
  const IterationRun iterate = [&](std::vector<IterationSummary>& history) {
    return run_spmd(
        work, tasks, communicator, machine, {config.steal, recording.method.coarse_correction},
        plan_of(0), {}, history,
        [&](std::vector<IterationSummary>& so_far) { return plan_of(so_far.size()); }, observer);
  };
  return run_ranks({prepared,
                    recording.basis,
                    shared->emitted,
                    {},
                    [&] { return std::pair(work.store_count(), work.residency_count()); }},
                   communicator, machine, iterate);
}

}  // namespace enfilade
