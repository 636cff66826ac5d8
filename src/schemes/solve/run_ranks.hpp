// The common parts of solving and replaying: the assignment of clusters to ranks, the costs of a
// tour, and the record of the run.
#pragma once

#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <vector>

#include "schemes/protocol/run_statistics.hpp"
#include "schemes/solve/solve.hpp"

namespace enfilade {

/// Returns the rank that each cluster is assigned to: computed on rank 0, the same on every rank.
/// All ranks call it.
std::vector<Rank> agree_on_owners(const Prepared& prepared, const SolveConfig& config,
                                  Communicator& communicator);
std::vector<ClusterId> clusters_of(std::span<const Rank> owners, Rank rank);

/// Returns OVG's edge costs, by the size of the clusters before refinement; `memory_bytes` 0 = no
/// limit.
VisibilityCost tour_cost(const Prepared& prepared, Basis basis, std::uint64_t memory_bytes);

/// Makes one object for all ranks where they share an address space, else one for each rank.
/// All ranks call it. Where `make` throws on rank 0, all ranks throw as from
/// Communicator::on_root().
template <class T, class Make>
std::shared_ptr<const T> share(Communicator& communicator, Make make) {
  if (!ranks_share_a_process()) return std::make_shared<const T>(make());
  std::shared_ptr<const T> object;
  communicator.on_root([&] { object = std::make_shared<const T>(make()); });
  const std::shared_ptr<const T>* first = &object;
  std::string address(reinterpret_cast<const char*>(&first), sizeof first);
  address = communicator.broadcast(address);
  std::memcpy(&first, address.data(), sizeof first);
  if (!communicator.root()) object = *first;
  communicator.barrier();  // rank 0's pointer lives until all have copied it
  return object;
}

/// Returns the emitted power of each cluster, in the band with the highest; point lights belong to
/// no cluster.
std::vector<double> emitted_powers(const Prepared& prepared);

/// The run that is about to start.
struct RankRun {
  const Prepared& prepared;
  Basis basis = Basis::linear;
  Spectrum emitted;                                               ///< power, per band
  std::vector<IterationSummary> history;                          ///< iterations before, on rank 0
  std::function<std::pair<StoreCount, ResidencyCount>()> counts;  ///< of this rank, at the end
};
/// Runs all iterations and appends to the history on rank 0. Returns the plan that ended the run.
using IterationRun = std::function<IterationPlan(std::vector<IterationSummary>& history)>;

/// All ranks call it. Runs the iterations and returns the record of RUN/stats.json on rank 0,
/// elsewhere an empty one.
RunRecord run_ranks(RankRun run, Communicator& communicator, Machine& machine,
                    const IterationRun& iterate);

}  // namespace enfilade
