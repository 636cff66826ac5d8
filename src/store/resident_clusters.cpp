#include "store/resident_clusters.hpp"

#include <algorithm>

namespace enfilade {
namespace {

/// A list of what to evict serves for an eighth of the budget: making it takes a look at all
/// clusters.
constexpr std::uint64_t list_share = 8;

/// In memory, a cluster's geometry and patches on the one hand, its links on the other.
RecordCount links_in_memory(const ClusterState& state) {
  const LinkSet& links = state.links();
  RecordCount count;
  count.links = links.size();
  count.bytes = links.size() * (sizeof(Link) + links.stride() * sizeof(float));
  return count;
}
RecordCount shooter_in_memory(const ClusterState& state) {
  RecordCount count;
  count.surfaces = state.patches().polygons();
  count.patches = state.patches().size();
  count.bytes = state.memory_bytes();
  count.bytes -= std::min(count.bytes, links_in_memory(state).bytes);
  return count;
}
void drop_links_of(ClusterState& state) { state.links() = LinkSet(state.links().stride()); }
void shrink(ClusterState& state) { state.shrink(); }

RecordCount links_in_memory(const RecordedCluster& state) {
  const SectionWeight& links = state.weight().links;
  return {0, 0, links.count, links.memory_bytes};
}
RecordCount shooter_in_memory(const RecordedCluster& state) {
  const ClusterWeight& weight = state.weight();
  return {weight.geometry.count, weight.patches.count, 0, weight.patches.memory_bytes};
}
void drop_links_of(RecordedCluster& state) { state.set_links({}); }
void shrink(RecordedCluster&) {}

}  // namespace

template <class State>
BasicResidentClusters<State>::BasicResidentClusters(ClusterSource<State>& source, Machine& machine,
                                                    std::uint64_t budget_bytes,
                                                    MemoryManager manager)
    : source_(source), machine_(machine), account_(machine, budget_bytes, manager) {
  next_use_ = [](ClusterId, bool links) { return links ? 1u : 0u; };
}

template <class State>
void BasicResidentClusters<State>::adopt(State state) {
  Entry& entry = entries_[state.id()];
  entry.state = std::make_unique<State>(std::move(state));
  entry.has_links = true;
  entry.iteration = source_.committed();
  measure(entry);
  evict();
}

template <class State>
void BasicResidentClusters<State>::measure(Entry& entry) {
  std::uint64_t shooter_bytes = 0, links_bytes = 0;
  if (entry.state) {
    shooter_bytes = machine_.record_bytes(shooter_in_memory(*entry.state));
    links_bytes = machine_.record_bytes(links_in_memory(*entry.state));
  }
  if (entry.previous) shooter_bytes += machine_.record_bytes(shooter_in_memory(*entry.previous));
  account_.resize(entry.memory, shooter_bytes, links_bytes);
}

template <class State>
ResidencyCount BasicResidentClusters<State>::count() const {
  return {account_.peak_bytes(), hits_, loads_, evictions_, account_.over_budget_bytes(),
          account_.placement()};
}

template <class State>
void BasicResidentClusters<State>::load(ClusterId id, Entry& entry) {
  const int iteration = newest_iteration(id);
  if (entry.state && entry.iteration >= iteration) {
    ++hits_;
    return;
  }
  ++loads_;
  entry.state = source_.read_shooter(id, Light::newest, entry.state.get());
  entry.has_links = entry.corrected = false;
  entry.iteration = iteration;
  measure(entry);
}

template <class State>
void BasicResidentClusters<State>::set_correction(std::function<void(State&)> correction) {
  correction_ = std::move(correction);
  entries_.for_each([](ClusterId, Entry& entry) { entry.corrected = false; });
}

/// The source has the light that the gathers made; the correction that belongs to the committed
/// iteration is applied to clusters that come from there, and to those that stayed in memory.
template <class State>
void BasicResidentClusters<State>::correct(Entry& entry) {
  if (!correction_ || entry.corrected || entry.iteration != source_.committed()) return;
  correction_(*entry.state);
  entry.corrected = true;
}

template <class State>
void BasicResidentClusters<State>::load_links(Entry& entry) {
  source_.read_links(*entry.state);
  entry.has_links = true;
  measure(entry);
}

template <class State>
void BasicResidentClusters<State>::set_jacobi(bool jacobi) {
  jacobi_ = jacobi;
  entries_.for_each([this](ClusterId id, Entry& entry) {
    if (!entry.previous) return;
    entry.previous.reset();
    measure(entry);
    if (!entry.state) entries_.erase(id);
  });
}

/// The cluster as it was before this rank gathered for it in this iteration.
template <class State>
const State& BasicResidentClusters<State>::committed(ClusterId id, Entry& entry) {
  if (!entry.previous) {
    entry.previous = source_.read_shooter(id, Light::committed, entry.state.get());
    if (correction_) correction_(*entry.previous);
    measure(entry);
  }
  return *entry.previous;
}

template <class State>
typename BasicResidentClusters<State>::Entry& BasicResidentClusters<State>::newest(ClusterId id) {
  Entry& entry = entries_[id];
  load(id, entry);
  correct(entry);
  return entry;
}

template <class State>
State& BasicResidentClusters<State>::pin_receiver(ClusterId id,
                                                  std::span<const ClusterId> visible) {
  receiver_ = id;
  visible_ = visible;
  Entry& entry = newest(id);
  if (!entry.has_links) load_links(entry);
  if (jacobi_ && !source_.written(id)) {
    entry.previous = std::make_unique<State>(entry.state->shooter());
    measure(entry);
  }
  evict();
  account_.use(id, entry.memory, true);
  return *entry.state;
}

template <class State>
const State& BasicResidentClusters<State>::pin_shooter(ClusterId id) {
  shooter_ = id;
  const State& state = shoots_as_committed(id) ? committed(id, entries_[id]) : *newest(id).state;
  evict();
  account_.use(id, entries_.find(id)->memory, false);
  return state;
}

template <class State>
bool BasicResidentClusters<State>::pinned(ClusterId id) const {
  return id == receiver_ || id == shooter_ || std::binary_search(held_.begin(), held_.end(), id);
}

template <class State>
void BasicResidentClusters<State>::list_missing(ClusterId id,
                                                std::vector<ShooterRequest>& missing) const {
  const Entry* entry = entries_.find(id);
  const bool here = entry != nullptr && entry->state != nullptr;
  const bool as_committed = shoots_as_committed(id);
  if (as_committed && entry != nullptr && entry->previous) return;
  if (here && !as_committed && entry->iteration >= newest_iteration(id)) return;
  missing.push_back({id, as_committed ? Light::committed : Light::newest, here});
}

template <class State>
void BasicResidentClusters<State>::hold(std::vector<ClusterId> shooters) {
  std::sort(shooters.begin(), shooters.end());
  shooters.erase(std::unique(shooters.begin(), shooters.end()), shooters.end());
  held_ = std::move(shooters);
  std::vector<ShooterRequest> missing;
  for (const ClusterId id : held_) list_missing(id, missing);
  source_.announce(missing);
  for (const ClusterId id : held_) pin_shooter(id);
  unpin();
}

template <class State>
WrittenReceiver BasicResidentClusters<State>::write_receiver(ClusterId id, bool links_changed) {
  Entry& entry = *entries_.find(id);
  shrink(*entry.state);
  const State& state = *entry.state;
  const SectionBytes written = source_.write(state, links_changed);
  entry.iteration = source_.committed() + 1;
  measure(entry);
  const RecordCount shooter = shooter_in_memory(state), links = links_in_memory(state);
  return {{shooter.patches, written.patches, shooter.bytes},
          {links.links, written.links, links.bytes}};
}

template <class State>
void BasicResidentClusters<State>::unpin() {
  receiver_ = shooter_ = ClusterId();
  visible_ = {};
  evict();
}

template <class State>
std::uint64_t BasicResidentClusters<State>::turns_until(ClusterId id, bool links) const {
  const bool to_come = !links && (!shooter_.valid() || shooter_ < id) &&
                       std::binary_search(visible_.begin(), visible_.end(), id);
  return to_come ? 0 : 1 + next_use_(id, links);
}

template <class State>
bool BasicResidentClusters<State>::may_go(const Entry* entry, ClusterId id, bool links) const {
  if (entry == nullptr) return false;
  return links ? entry->has_links && id != receiver_ : !pinned(id);
}

template <class State>
std::vector<EvictionCandidate> BasicResidentClusters<State>::eviction_candidates() const {
  std::vector<EvictionCandidate> candidates;
  entries_.for_each([&](ClusterId id, const Entry& entry) {
    for (const bool links : {true, false}) {
      if (may_go(&entry, id, links)) candidates.push_back({turns_until(id, links), links, id});
    }
  });
  return candidates;
}

template <class State>
void BasicResidentClusters<State>::drop(Entry& entry, ClusterId id, bool links) {
  if (links) {
    drop_links_of(*entry.state);
    entry.has_links = false;
  } else {
    entry.state.reset();
    entry.previous.reset();
  }
  measure(entry);
  if (!links) entries_.erase(id);
  ++evictions_;
}

template <class State>
void BasicResidentClusters<State>::evict() {
  const std::uint64_t goal = account_.goal_bytes();
  const std::uint64_t before = account_.bytes();
  bool listed_now = false;
  while (account_.bytes() > goal) {
    if (order_.out_of_date()) {
      order_.set(eviction_candidates(), account_.budget_bytes() / list_share);
      listed_now = true;
      if (order_.empty()) break;
    }
    const auto [turns, links, id] = order_.take();
    Entry* entry = entries_.find(id);
    if (!may_go(entry, id, links)) continue;
    if (!listed_now && turns_until(id, links) < turns / 2) continue;  // its use has come near
    const std::uint64_t bytes = account_.bytes();
    drop(*entry, id, links);
    order_.note_evicted(bytes - account_.bytes());
  }
  account_.return_freed(before - account_.bytes());
}

template <class State>
std::vector<ClusterId> BasicResidentClusters<State>::resident() const {
  std::vector<ClusterId> ids;
  entries_.for_each([&ids](ClusterId id, const Entry&) { ids.push_back(id); });
  return ids;
}

template class BasicResidentClusters<ClusterState>;
template class BasicResidentClusters<RecordedCluster>;

}  // namespace enfilade
