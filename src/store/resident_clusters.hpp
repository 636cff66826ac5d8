// The clusters in a rank's memory, within its budget (§3.2, §4.4).
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "hierarchy/cluster_state.hpp"
#include "machine/machine.hpp"
#include "store/cluster_source.hpp"
#include "store/cluster_table.hpp"
#include "store/eviction_order.hpp"
#include "store/memory_account.hpp"
#include "store/recorded_cluster.hpp"

namespace enfilade {

struct ResidencyCount {
  std::uint64_t peak_bytes = 0;  ///< of clusters in memory at once
  std::uint64_t hits = 0, loads = 0, evictions = 0;
  /// Most by which the budget was passed: by the last cluster that came in before others could go,
  /// or by a gather whose receiver and one shooter are more than the budget.
  std::uint64_t over_budget_bytes = 0;
  /// Where there is a budget: what the memory manager made of it.
  SimulatedPlacementCount placement;
};

/// What write_receiver() wrote, and what the cluster takes in memory then.
struct WrittenReceiver {
  SectionWeight patches, links;  ///< links.file_bytes is 0 where they did not change
};

/// A cluster has two parts here: geometry and patches, with which it shoots, and its links, which
/// only its own gather needs, once per iteration. When memory is short, the part whose next use is
/// farthest in the future is evicted first; CYCLE tells how far (Belady's rule, which is optimal).
/// Nothing is ever written on eviction: a gathered cluster was written after its gather.
/// State is ClusterState, or RecordedCluster where a run is replayed.
template <class State>
class BasicResidentClusters {
 public:
  /// When a cluster (or its links) will be used next; larger is later.
  using NextUse = std::function<std::uint64_t(ClusterId id, bool links)>;

  /// budget_bytes 0 = no limit. `source` and `machine` must outlive it.
  BasicResidentClusters(ClusterSource<State>& source, Machine& machine, std::uint64_t budget_bytes,
                        MemoryManager manager = MemoryManager::own);

  void set_next_use(NextUse next_use) { next_use_ = std::move(next_use); }
  /// Sets the change that is applied to each cluster of the committed iteration, once, before it is
  /// used.
  void set_correction(std::function<void(State&)> correction);
  /// Brings these clusters in as shooters, all at once, and keeps them until the next call,
  /// whatever the budget.
  void hold(std::vector<ClusterId> shooters);
  /// Takes in a cluster with its links that is as the source has it.
  void adopt(State state);

  /// While `jacobi`, shooters are as the last iteration committed them, this rank's own included:
  /// the light that a gather takes then does not depend on who gathers, or when.
  void set_jacobi(bool jacobi);

  /// Keeps the receiver of a gather in memory until unpin(). `visible` (ascending, valid until
  /// then): the shooters that will be asked for, in this order; those still to come stay longest.
  State& pin_receiver(ClusterId id, std::span<const ClusterId> visible = {});
  /// Keeps a shooter in memory until the next one is asked for, or unpin().
  const State& pin_shooter(ClusterId id);
  /// Writes the receiver after its gather; its links only where the gather changed them.
  WrittenReceiver write_receiver(ClusterId id, bool links_changed);
  /// Ends the gather and evicts down to the budget.
  void unpin();

  /// Returns the clusters in memory, in the order of their ids.
  std::vector<ClusterId> resident() const;
  ResidencyCount count() const;
  std::uint64_t bytes() const { return account_.bytes(); }

 private:
  struct Entry {
    std::unique_ptr<State> state;
    std::unique_ptr<State> previous;  ///< as committed, once it has been gathered for
    bool has_links = false, corrected = false;
    int iteration = 0;  ///< that these patches are of
    ClusterMemory memory;
  };
  Entry& newest(ClusterId id);
  void load(ClusterId id, Entry& entry);
  const State& committed(ClusterId id, Entry& entry);
  void correct(Entry& entry);
  void load_links(Entry& entry);
  /// Brings the account of memory up to date with what the entry holds now.
  void measure(Entry& entry);
  /// Turns until a part is used again; 0 = in the gather at hand.
  std::uint64_t turns_until(ClusterId id, bool links) const;
  bool pinned(ClusterId id) const;
  /// Returns the newest iteration of a cluster that this rank may see: the one under way, or the
  /// committed one.
  int newest_iteration(ClusterId id) const { return source_.committed() + source_.written(id); }
  /// Does it shoot with the light before this iteration, though newer light is known?
  bool shoots_as_committed(ClusterId id) const { return jacobi_ && source_.written(id); }
  /// Appends what has to be read before the cluster can shoot.
  void list_missing(ClusterId id, std::vector<ShooterRequest>& missing) const;
  void evict();
  bool may_go(const Entry* entry, ClusterId id, bool links) const;
  std::vector<EvictionCandidate> eviction_candidates() const;
  void drop(Entry& entry, ClusterId id, bool links);

  ClusterSource<State>& source_;
  Machine& machine_;
  MemoryAccount account_;
  EvictionOrder order_;
  NextUse next_use_;
  bool jacobi_ = false;
  std::function<void(State&)> correction_;
  ClusterTable<Entry> entries_;
  ClusterId receiver_, shooter_;  ///< of the gather at hand; none = not valid
  std::span<const ClusterId> visible_;
  std::vector<ClusterId> held_;  ///< ascending
  std::uint64_t hits_ = 0, loads_ = 0, evictions_ = 0;
};

using ResidentClusters = BasicResidentClusters<ClusterState>;
extern template class BasicResidentClusters<ClusterState>;
extern template class BasicResidentClusters<RecordedCluster>;

}  // namespace enfilade
