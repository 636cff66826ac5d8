#include "store/resident_clusters.hpp"

#include <malloc.h>

#include <algorithm>
#include <tuple>

namespace enfilade {
namespace {

RecordCount shooter_record(const ClusterState& state) {
  RecordCount count;
  count.surfaces = state.patches().polygons();
  count.patches = state.patches().size();
  return count;
}

RecordCount links_record(const ClusterState& state) {
  RecordCount count;
  count.links = state.links().size();
  return count;
}

/// The newest that this rank may see: its own of this iteration, or the committed one.
int newest_iteration(const ClusterFiles& files, ClusterId id) {
  return files.committed() + (files.written(id) ? 1 : 0);
}

}  // namespace

ResidentClusters::ResidentClusters(ClusterFiles& files, Machine& machine,
                                   std::uint64_t budget_bytes, MemoryManager manager)
    : files_(files),
      machine_(machine),
      budget_bytes_(budget_bytes),
      manager_(manager),
      placement_(manager, budget_bytes) {
  next_use_ = [](ClusterId, bool links) { return links ? 1u : 0u; };
}

void ResidentClusters::adopt(ClusterState state) {
  Entry& entry = entries_[state.id()];
  entry.links_checksum = checksum(state.bytes_of(Section::links));
  entry.state = std::make_unique<ClusterState>(std::move(state));
  entry.has_links = true;
  entry.iteration = files_.committed();
  measure(entry);
  evict(false);
}

/// Brings the account of memory up to date with what the entry holds now.
void ResidentClusters::measure(Entry& entry) {
  bytes_ -= entry.shooter_bytes + entry.links_bytes;
  entry.shooter_bytes = entry.links_bytes = 0;
  if (entry.state) {
    RecordCount shooter = shooter_record(*entry.state), links = links_record(*entry.state);
    const auto& set = entry.state->links();
    links.bytes = set.size() * (sizeof(Link) + set.stride() * sizeof(float));
    shooter.bytes = entry.state->memory_bytes();
    shooter.bytes -= std::min(shooter.bytes, links.bytes);
    entry.shooter_bytes = machine_.record_bytes(shooter);
    entry.links_bytes = machine_.record_bytes(links);
  }
  if (entry.previous) {
    RecordCount previous = shooter_record(*entry.previous);
    previous.bytes = entry.previous->memory_bytes();
    entry.shooter_bytes += machine_.record_bytes(previous);
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

void ResidentClusters::use(ClusterId id, const Entry& entry, bool links) {
  std::uint64_t swapped = placement_.use(entry.shooter_block);
  if (links) swapped += placement_.use(entry.links_block);
  if (swapped == 0) return;
  const PhaseScope phase(machine_, Phase::io);
  machine_.read(Disk::local, id.value, swapped);
}

ResidencyCount ResidentClusters::count() const {
  ResidencyCount count = count_;
  count.placement = placement_.count();
  return count;
}

void ResidentClusters::load(ClusterId id, Entry& entry) {
  if (entry.state && entry.iteration >= newest_iteration(files_, id)) {
    ++count_.hits;
    return;
  }
  ++count_.loads;
  const std::vector<std::byte> geometry =
      entry.state ? entry.state->bytes_of(Section::geometry) : files_.read_geometry(id).bytes;
  const SectionFile patches = files_.read_patches(id);
  entry.state =
      std::make_unique<ClusterState>(geometry, patches.bytes, std::span<const std::byte>());
  entry.has_links = entry.corrected = false;
  entry.iteration = static_cast<int>(patches.info.iteration);
  measure(entry);
}

void ResidentClusters::set_correction(std::function<void(ClusterState&)> correction) {
  correction_ = std::move(correction);
  for (auto& [id, entry] : entries_) entry.corrected = false;
}

/// Files hold what the gathers brought; the correction that belongs to the committed iteration is
/// applied to what comes from them, and to what stayed in memory.
void ResidentClusters::correct(Entry& entry) {
  if (!correction_ || entry.corrected || entry.iteration != files_.committed()) return;
  correction_(*entry.state);
  entry.corrected = true;
}

void ResidentClusters::load_links(ClusterId id, Entry& entry) {
  const SectionFile links = files_.read_links(id);
  entry.state =
      std::make_unique<ClusterState>(entry.state->bytes_of(Section::geometry),
                                     entry.state->bytes_of(Section::patches), links.bytes);
  entry.has_links = true;
  entry.links_checksum = checksum(links.bytes);
  measure(entry);
}

void ResidentClusters::set_committed_only(bool committed_only) {
  committed_only_ = committed_only;
  for (auto& [id, entry] : entries_) {
    if (!entry.previous) continue;
    entry.previous.reset();
    measure(entry);
  }
  std::erase_if(entries_, [](const auto& entry) { return !entry.second.state; });
}

/// The cluster as it was before this rank gathered for it in this iteration.
const ClusterState& ResidentClusters::committed(ClusterId id, Entry& entry) {
  if (!entry.previous) {
    const std::vector<std::byte> geometry =
        entry.state ? entry.state->bytes_of(Section::geometry) : files_.read_geometry(id).bytes;
    entry.previous = std::make_unique<ClusterState>(
        geometry, files_.read_committed_patches(id).bytes, std::span<const std::byte>());
    if (correction_) correction_(*entry.previous);
    measure(entry);
  }
  return *entry.previous;
}

ResidentClusters::Entry& ResidentClusters::newest(ClusterId id) {
  Entry& entry = entries_[id];
  load(id, entry);
  correct(entry);
  return entry;
}

ClusterState& ResidentClusters::pin_receiver(ClusterId id, std::span<const ClusterId> visible) {
  receiver_ = id;
  visible_ = visible;
  Entry& entry = newest(id);
  if (!entry.has_links) load_links(id, entry);
  if (committed_only_ && !files_.written(id)) {
    entry.previous = std::make_unique<ClusterState>(entry.state->shooter());
    measure(entry);
  }
  evict(true);
  use(id, entry, true);
  return *entry.state;
}

const ClusterState& ResidentClusters::pin_shooter(ClusterId id) {
  shooter_ = id;
  const ClusterState& state =
      shoots_as_committed(id) ? committed(id, entries_[id]) : *newest(id).state;
  evict(true);
  use(id, entries_.at(id), false);
  return state;
}

bool ResidentClusters::pinned(ClusterId id) const {
  return id == receiver_ || id == shooter_ || std::binary_search(held_.begin(), held_.end(), id);
}

void ResidentClusters::list_missing(ClusterId id, std::vector<SectionName>& missing) const {
  const auto found = entries_.find(id);
  const Entry* entry = found == entries_.end() ? nullptr : &found->second;
  const bool here = entry != nullptr && entry->state != nullptr;
  const bool as_committed = shoots_as_committed(id);
  if (as_committed && entry != nullptr && entry->previous) return;
  if (!here) missing.push_back({id, Section::geometry});
  if (as_committed || !here || entry->iteration < newest_iteration(files_, id)) {
    missing.push_back({id, Section::patches, as_committed || !files_.written(id)});
  }
}

void ResidentClusters::hold(std::vector<ClusterId> shooters) {
  std::sort(shooters.begin(), shooters.end());
  shooters.erase(std::unique(shooters.begin(), shooters.end()), shooters.end());
  held_ = std::move(shooters);
  std::vector<SectionName> missing;
  for (const ClusterId id : held_) list_missing(id, missing);
  files_.announce(missing);
  for (const ClusterId id : held_) pin_shooter(id);
  unpin();
}

void ResidentClusters::write_receiver(ClusterId id) {
  Entry& entry = entries_.at(id);
  RecordCount patches_count = shooter_record(*entry.state),
              links_count = links_record(*entry.state);
  patches_count.surfaces = 0;
  const std::vector<std::byte> patches = entry.state->bytes_of(Section::patches);
  std::vector<std::byte> links = entry.state->bytes_of(Section::links);
  patches_count.bytes = patches.size();
  links_count.bytes = links.size();
  const std::uint64_t sum = checksum(links);
  if (sum == entry.links_checksum) links.clear();
  files_.write(id, patches, patches_count, links, links_count);
  entry.links_checksum = sum;
  entry.iteration = files_.committed() + 1;
  measure(entry);
}

void ResidentClusters::unpin() {
  receiver_ = shooter_ = ClusterId();
  visible_ = {};
  evict(false);
}

std::uint64_t ResidentClusters::turns_until(ClusterId id, bool links) const {
  const bool to_come = !links && (!shooter_.valid() || shooter_ < id) &&
                       std::binary_search(visible_.begin(), visible_.end(), id);
  return to_come ? 0 : 1 + next_use_(id, links);
}

void ResidentClusters::drop_links(Entry& entry) {
  entry.state->links() = LinkSet(entry.state->links().stride());
  entry.has_links = false;
}

void ResidentClusters::evict(bool pressed) {
  if (budget_bytes_ == 0) return;
  // The next cluster comes in before others go: there must be room for it, or the system would
  // swap.
  const std::uint64_t limit = budget_bytes_ - std::min(budget_bytes_ / 2, largest_bytes_);
  if (bytes_ <= limit) return;
  // A little more than needed, so that the order is not worked out for every cluster that comes in.
  const std::uint64_t goal = limit - (pressed ? limit / 16 : 0);
  using Part = std::tuple<std::uint64_t, bool, ClusterId>;  // next use, links, whose
  std::vector<Part> parts;
  for (const auto& [id, entry] : entries_) {
    if (entry.has_links && id != receiver_) parts.emplace_back(turns_until(id, true), true, id);
    if (!pinned(id)) parts.emplace_back(turns_until(id, false), false, id);
  }
  std::sort(parts.begin(), parts.end(), std::greater<>());
  for (const auto& [when, links, id] : parts) {
    if (bytes_ <= goal) break;
    const auto found = entries_.find(id);
    if (found == entries_.end()) continue;
    const std::uint64_t before = bytes_;
    if (links) {
      drop_links(found->second);
    } else {
      found->second.state.reset();
      found->second.previous.reset();
    }
    measure(found->second);
    if (!links) entries_.erase(found);
    freed_bytes_ += before - bytes_;
    ++count_.evictions;
  }
  // What was freed lies scattered in the allocator's heap and would still count as resident (§4.4).
  if (manager_ == MemoryManager::own && freed_bytes_ > budget_bytes_ / 8) {
    malloc_trim(0);
    freed_bytes_ = 0;
  }
}

std::vector<ClusterId> ResidentClusters::resident() const {
  std::vector<ClusterId> ids;
  for (const auto& [id, entry] : entries_) ids.push_back(id);
  return ids;
}

}  // namespace enfilade
