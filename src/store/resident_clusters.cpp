#include "store/resident_clusters.hpp"

#include <malloc.h>

#include <algorithm>

namespace enfilade {
namespace {

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
std::uint64_t file_bytes(const ClusterState&, Section, std::size_t bytes) { return bytes; }

RecordCount links_in_memory(const RecordedCluster& state) {
  const SectionWeight& links = state.weight().links;
  return {0, 0, links.count, links.memory_bytes};
}
RecordCount shooter_in_memory(const RecordedCluster& state) {
  const ClusterWeight& weight = state.weight();
  return {weight.geometry.count, weight.patches.count, 0, weight.patches.memory_bytes};
}
void drop_links_of(RecordedCluster& state) { state.drop_links(); }
void shrink(RecordedCluster&) {}
std::uint64_t file_bytes(const RecordedCluster& state, Section section, std::size_t) {
  const ClusterWeight& weight = state.weight();
  return section == Section::links ? weight.links.file_bytes : weight.patches.file_bytes;
}

/// The newest that this rank may see: its own of this iteration, or the committed one.
int newest_iteration(const ClusterFiles& files, ClusterId id) {
  return files.committed() + (files.written(id) ? 1 : 0);
}

}  // namespace

template <class State>
BasicResidentClusters<State>::BasicResidentClusters(ClusterFiles& files, Machine& machine,
                                                    std::uint64_t budget_bytes,
                                                    MemoryManager manager)
    : files_(files),
      machine_(machine),
      budget_bytes_(budget_bytes),
      manager_(manager),
      placement_(manager, budget_bytes) {
  next_use_ = [](ClusterId, bool links) { return links ? 1u : 0u; };
}

template <class State>
void BasicResidentClusters<State>::adopt(State state) {
  Entry& entry = entries_[state.id()];
  entry.links_checksum = checksum(state.bytes_of(Section::links));
  entry.state = std::make_unique<State>(std::move(state));
  entry.has_links = true;
  entry.iteration = files_.committed();
  measure(entry);
  evict();
}

/// Brings the account of memory up to date with what the entry holds now.
template <class State>
void BasicResidentClusters<State>::measure(Entry& entry) {
  bytes_ -= entry.shooter_bytes + entry.links_bytes;
  entry.shooter_bytes = entry.links_bytes = 0;
  if (entry.state) {
    entry.shooter_bytes = machine_.record_bytes(shooter_in_memory(*entry.state));
    entry.links_bytes = machine_.record_bytes(links_in_memory(*entry.state));
  }
  if (entry.previous) {
    entry.shooter_bytes += machine_.record_bytes(shooter_in_memory(*entry.previous));
  }
  if (budget_bytes_ > 0) {
    entry.shooter_bytes = placement_.accounted(entry.shooter_bytes);
    entry.links_bytes = placement_.accounted(entry.links_bytes);
    placement_.resize(entry.shooter_block, entry.shooter_bytes);
    placement_.resize(entry.links_block, entry.links_bytes);
  }
  bytes_ += entry.shooter_bytes + entry.links_bytes;
  largest_bytes_ = std::max(largest_bytes_, entry.shooter_bytes + entry.links_bytes);
  count_.peak_bytes = std::max(count_.peak_bytes, bytes_);
  if (budget_bytes_ > 0 && count_.peak_bytes > budget_bytes_) {
    count_.over_budget_bytes = count_.peak_bytes - budget_bytes_;
  }
}

template <class State>
void BasicResidentClusters<State>::use(ClusterId id, const Entry& entry, bool links) {
  std::uint64_t swapped = placement_.use(entry.shooter_block);
  if (links) swapped += placement_.use(entry.links_block);
  if (swapped == 0) return;
  const PhaseScope phase(machine_, Phase::io);
  machine_.read(Disk::local, id.value, swapped);
}

template <class State>
ResidencyCount BasicResidentClusters<State>::count() const {
  ResidencyCount count = count_;
  count.placement = placement_.count();
  return count;
}

template <class State>
void BasicResidentClusters<State>::load(ClusterId id, Entry& entry) {
  if (entry.state && entry.iteration >= newest_iteration(files_, id)) {
    ++count_.hits;
    return;
  }
  ++count_.loads;
  const std::vector<std::byte> geometry =
      entry.state ? entry.state->bytes_of(Section::geometry) : files_.read_geometry(id).bytes;
  const SectionFile patches = files_.read_patches(id);
  entry.state = std::make_unique<State>(geometry, patches.bytes, std::span<const std::byte>());
  entry.has_links = entry.corrected = false;
  entry.iteration = static_cast<int>(patches.info.iteration);
  measure(entry);
}

template <class State>
void BasicResidentClusters<State>::set_correction(std::function<void(State&)> correction) {
  correction_ = std::move(correction);
  entries_.for_each([](ClusterId, Entry& entry) { entry.corrected = false; });
}

/// Files hold what the gathers brought; the correction that belongs to the committed iteration is
/// applied to what comes from them, and to what stayed in memory.
template <class State>
void BasicResidentClusters<State>::correct(Entry& entry) {
  if (!correction_ || entry.corrected || entry.iteration != files_.committed()) return;
  correction_(*entry.state);
  entry.corrected = true;
}

template <class State>
void BasicResidentClusters<State>::load_links(ClusterId id, Entry& entry) {
  const SectionFile links = files_.read_links(id);
  entry.state = std::make_unique<State>(entry.state->bytes_of(Section::geometry),
                                        entry.state->bytes_of(Section::patches), links.bytes);
  entry.has_links = true;
  entry.links_checksum = checksum(links.bytes);
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
    const std::vector<std::byte> geometry =
        entry.state ? entry.state->bytes_of(Section::geometry) : files_.read_geometry(id).bytes;
    entry.previous = std::make_unique<State>(geometry, files_.read_committed_patches(id).bytes,
                                             std::span<const std::byte>());
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
  if (!entry.has_links) load_links(id, entry);
  if (jacobi_ && !files_.written(id)) {
    entry.previous = std::make_unique<State>(entry.state->shooter());
    measure(entry);
  }
  evict();
  use(id, entry, true);
  return *entry.state;
}

template <class State>
const State& BasicResidentClusters<State>::pin_shooter(ClusterId id) {
  shooter_ = id;
  const State& state = shoots_as_committed(id) ? committed(id, entries_[id]) : *newest(id).state;
  evict();
  use(id, *entries_.find(id), false);
  return state;
}

template <class State>
bool BasicResidentClusters<State>::pinned(ClusterId id) const {
  return id == receiver_ || id == shooter_ || std::binary_search(held_.begin(), held_.end(), id);
}

template <class State>
void BasicResidentClusters<State>::list_missing(ClusterId id,
                                                std::vector<SectionName>& missing) const {
  const Entry* entry = entries_.find(id);
  const bool here = entry != nullptr && entry->state != nullptr;
  const bool as_committed = shoots_as_committed(id);
  if (as_committed && entry != nullptr && entry->previous) return;
  if (!here) missing.push_back({id, Section::geometry});
  if (as_committed || !here || entry->iteration < newest_iteration(files_, id)) {
    missing.push_back({id, Section::patches, as_committed || !files_.written(id)});
  }
}

template <class State>
void BasicResidentClusters<State>::hold(std::vector<ClusterId> shooters) {
  std::sort(shooters.begin(), shooters.end());
  shooters.erase(std::unique(shooters.begin(), shooters.end()), shooters.end());
  held_ = std::move(shooters);
  std::vector<SectionName> missing;
  for (const ClusterId id : held_) list_missing(id, missing);
  files_.announce(missing);
  for (const ClusterId id : held_) pin_shooter(id);
  unpin();
}

template <class State>
WrittenReceiver BasicResidentClusters<State>::write_receiver(ClusterId id) {
  Entry& entry = *entries_.find(id);
  shrink(*entry.state);
  const State& state = *entry.state;
  const RecordCount shooter = shooter_in_memory(state), links_count = links_in_memory(state);
  WrittenReceiver written;
  written.patches = {shooter.patches, 0, shooter.bytes, 0};
  written.links = {links_count.links, 0, links_count.bytes, 0};
  const std::vector<std::byte> patches = state.bytes_of(Section::patches);
  std::vector<std::byte> links = state.bytes_of(Section::links);
  written.patches.file_bytes = file_bytes(state, Section::patches, patches.size());
  written.links.file_bytes = file_bytes(state, Section::links, links.size());
  const std::uint64_t sum = checksum(links);
  written.links_changed = sum != entry.links_checksum;
  if (!written.links_changed) links.clear();
  files_.write(id, patches, {0, shooter.patches, 0, written.patches.file_bytes}, links,
               {0, 0, links_count.links, written.links.file_bytes});
  entry.links_checksum = written.links.version = sum;
  entry.iteration = files_.committed() + 1;
  measure(entry);
  return written;
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
void BasicResidentClusters<State>::drop_links(Entry& entry) {
  drop_links_of(*entry.state);
  entry.has_links = false;
}

template <class State>
bool BasicResidentClusters<State>::may_go(const Entry* entry, ClusterId id, bool links) const {
  if (entry == nullptr) return false;
  return links ? entry->has_links && id != receiver_ : !pinned(id);
}

template <class State>
void BasicResidentClusters<State>::list_parts() {
  parts_.clear();
  entries_.for_each([&](ClusterId id, const Entry& entry) {
    for (const bool links : {true, false}) {
      if (may_go(&entry, id, links)) parts_.emplace_back(turns_until(id, links), links, id);
    }
  });
  std::make_heap(parts_.begin(), parts_.end());
  parts_good_for_bytes_ = budget_bytes_ / 8;
}

template <class State>
void BasicResidentClusters<State>::drop(Entry& entry, ClusterId id, bool links) {
  const std::uint64_t before = bytes_;
  if (links) {
    drop_links(entry);
  } else {
    entry.state.reset();
    entry.previous.reset();
  }
  measure(entry);
  if (!links) entries_.erase(id);
  const std::uint64_t freed = before - bytes_;
  freed_bytes_ += freed;
  parts_good_for_bytes_ -= std::min(parts_good_for_bytes_, freed);
  ++count_.evictions;
}

template <class State>
void BasicResidentClusters<State>::evict() {
  if (budget_bytes_ == 0) return;
  // The next cluster comes in before others go: there must be room for it, or the system would
  // swap.
  const std::uint64_t limit = budget_bytes_ - std::min(budget_bytes_ / 2, largest_bytes_);
  if (bytes_ <= limit) return;
  // A little more than needed, so that this is not done for every cluster that comes in; and in the
  // order worked out a while ago, where what was farthest then is far still.
  const std::uint64_t goal = limit - limit / 32;
  bool now = false;
  while (bytes_ > goal) {
    if (parts_.empty() || parts_good_for_bytes_ == 0) {
      list_parts();
      now = true;
      if (parts_.empty()) break;
    }
    std::pop_heap(parts_.begin(), parts_.end());
    const auto [turns, links, id] = parts_.back();
    parts_.pop_back();
    Entry* entry = entries_.find(id);
    if (!may_go(entry, id, links)) continue;
    if (now || turns_until(id, links) >= turns / 2) drop(*entry, id, links);
  }
  // What was freed lies scattered in the allocator's heap and would still count as resident (§4.4);
  // on a simulated machine memory is counted, not measured.
  if (manager_ == MemoryManager::own && !ranks_share_a_process() &&
      freed_bytes_ > budget_bytes_ / 8) {
    malloc_trim(0);
    freed_bytes_ = 0;
  }
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
