// The clusters in a rank's memory, within its budget (§3.2, §4.4).
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <tuple>
#include <vector>

#include "hierarchy/cluster_state.hpp"
#include "machine/machine.hpp"
#include "store/cluster_files.hpp"
#include "store/cluster_table.hpp"
#include "store/recorded_cluster.hpp"
#include "store/simulated_placement.hpp"

namespace enfilade {

struct ResidencyCount {
  std::uint64_t peak_bytes = 0;  ///< of clusters in memory at once
  std::uint64_t hits = 0, loads = 0, evictions = 0;
  /// Most by which the budget was passed: by the last cluster that came in before others could go,
  /// or by a gather whose receiver and one shooter are more than there is.
  std::uint64_t over_budget_bytes = 0;
  /// Where there is a budget: what the memory manager made of it.
  SimulatedPlacementCount placement;
};

/// What write_receiver() wrote, and what the cluster takes in memory then.
struct WrittenReceiver {
  SectionWeight patches, links;
  bool links_changed = false;  ///< only then were they written
};

/// A cluster has two parts here: what it shoots with (geometry and patches), and its links, which
/// only its own gather needs, once an iteration. Under pressure that part goes first whose next use
/// lies farthest ahead; since CYCLE is known, so is that (Belady's rule, which no other can beat).
/// Nothing is ever written on eviction: a gathered cluster is in its file already.
/// State is ClusterState, or RecordedCluster where a run is replayed.
template <class State>
class BasicResidentClusters {
 public:
  /// When a cluster (or its links) will be used next; larger is later.
  using NextUse = std::function<std::uint64_t(ClusterId id, bool links)>;

  /// budget_bytes 0 = no limit.
  BasicResidentClusters(ClusterFiles& files, Machine& machine, std::uint64_t budget_bytes,
                        MemoryManager manager = MemoryManager::own);

  void set_next_use(NextUse next_use) { next_use_ = std::move(next_use); }
  /// From now on, each cluster of the committed iteration is changed so, once, before it is used.
  void set_correction(std::function<void(State&)> correction);
  /// Brings these clusters in as shooters, all at once, and keeps them until the next call,
  /// whatever the budget.
  void hold(std::vector<ClusterId> shooters);
  /// Takes in a cluster that was made here and written by ClusterStore::write_initial.
  void adopt(State state);

  /// While `committed_only`, shooters are as the last iteration committed them, this rank's own
  /// included: what is gathered then does not depend on who gathers it, or when.
  void set_jacobi(bool jacobi);

  /// Keeps the receiver of a gather in memory until unpin(). `visible` (ascending, valid until
  /// then): the shooters that will be asked for, in this order; those still to come stay longest.
  State& pin_receiver(ClusterId id, std::span<const ClusterId> visible = {});
  /// Keeps a shooter in memory until the next one is asked for, or unpin().
  const State& pin_shooter(ClusterId id);
  /// After its gather: writes the receiver to the local directory (its links only where they
  /// changed).
  WrittenReceiver write_receiver(ClusterId id);
  /// Ends the gather and evicts down to the budget.
  void unpin();

  /// In the order of their ids.
  std::vector<ClusterId> resident() const;
  ResidencyCount count() const;
  std::uint64_t bytes() const { return bytes_; }

 private:
  struct Entry {
    std::unique_ptr<State> state;
    std::unique_ptr<State> previous;  ///< as committed, once it has been gathered for
    bool has_links = false, corrected = false;
    int iteration = 0;                 ///< that these patches are of
    std::uint64_t links_checksum = 0;  ///< of the links in the file
    std::uint64_t shooter_bytes = 0, links_bytes = 0;
    SimulatedPlacement::Block shooter_block = 0, links_block = 0;
  };
  Entry& newest(ClusterId id);
  void load(ClusterId id, Entry& entry);
  const State& committed(ClusterId id, Entry& entry);
  void correct(Entry& entry);
  void load_links(ClusterId id, Entry& entry);
  void measure(Entry& entry);
  /// Its memory is used; what the system had to swap for that takes its time.
  void use(ClusterId id, const Entry& entry, bool links);
  /// Turns until a part is used again; 0 = in the gather at hand.
  std::uint64_t turns_until(ClusterId id, bool links) const;
  bool pinned(ClusterId id) const;
  /// Is what pin_shooter() gives of it the light before this iteration?
  bool shoots_as_committed(ClusterId id) const { return jacobi_ && files_.written(id); }
  /// What has to be read for it to shoot.
  void list_missing(ClusterId id, std::vector<SectionName>& missing) const;
  void evict();
  bool may_go(const Entry* entry, ClusterId id, bool links) const;
  /// Puts all that may go into parts_.
  void list_parts();
  void drop(Entry& entry, ClusterId id, bool links);
  void drop_links(Entry& entry);

  ClusterFiles& files_;
  Machine& machine_;
  std::uint64_t budget_bytes_;
  MemoryManager manager_;
  SimulatedPlacement placement_;
  NextUse next_use_;
  bool jacobi_ = false;
  std::function<void(State&)> correction_;
  ClusterTable<Entry> entries_;
  ClusterId receiver_, shooter_;  ///< of the gather at hand; none = not valid
  std::span<const ClusterId> visible_;
  std::vector<ClusterId> held_;  ///< ascending
  std::uint64_t bytes_ = 0, freed_bytes_ = 0;
  std::uint64_t largest_bytes_ = 0;  ///< that a cluster has taken so far: room for the next one
  ResidencyCount count_;
  using Part = std::tuple<std::uint64_t, bool, ClusterId>;  ///< turns until its use, links?, whose
  std::vector<Part> parts_;                 ///< a heap: what could go, as it was when it was listed
  std::uint64_t parts_good_for_bytes_ = 0;  ///< then the list is too old
};

using ResidentClusters = BasicResidentClusters<ClusterState>;
extern template class BasicResidentClusters<ClusterState>;
extern template class BasicResidentClusters<RecordedCluster>;

}  // namespace enfilade
