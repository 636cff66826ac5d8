#include "store/memory_account.hpp"

#include <algorithm>

namespace enfilade {
namespace {

/// Evictions go on a 32nd of the budget below its limit, so that not every cluster that comes in
/// makes others go.
constexpr std::uint64_t slack_share = 32;
/// Returning memory walks through the whole heap: done after each eighth of the budget only.
constexpr std::uint64_t returned_share = 8;

}  // namespace

void MemoryAccount::resize(ClusterMemory& memory, std::uint64_t shooter_bytes,
                           std::uint64_t links_bytes) {
  bytes_ -= memory.bytes();
  if (budget_bytes_ > 0) {
    shooter_bytes = placement_.accounted(shooter_bytes);
    links_bytes = placement_.accounted(links_bytes);
    placement_.resize(memory.shooter_block, shooter_bytes);
    placement_.resize(memory.links_block, links_bytes);
  }
  memory.shooter_bytes = shooter_bytes;
  memory.links_bytes = links_bytes;
  bytes_ += memory.bytes();
  largest_bytes_ = std::max(largest_bytes_, memory.bytes());
  peak_bytes_ = std::max(peak_bytes_, bytes_);
}

void MemoryAccount::use(ClusterId id, const ClusterMemory& memory, bool links) {
  std::uint64_t swapped = placement_.use(memory.shooter_block);
  if (links) swapped += placement_.use(memory.links_block);
  if (swapped == 0) return;
  const PhaseScope phase(machine_, Phase::io);
  machine_.read(Disk::local, id.value, swapped);
}

void MemoryAccount::return_freed(std::uint64_t evicted_bytes) {
  evicted_bytes_ += evicted_bytes;
  if (manager_ != MemoryManager::own || evicted_bytes_ <= budget_bytes_ / returned_share) return;
  machine_.return_freed_memory();
  evicted_bytes_ = 0;
}

std::uint64_t MemoryAccount::goal_bytes() const {
  if (budget_bytes_ == 0) return bytes_;
  // The next cluster comes in before others go: there must be room for it, or the system would
  // swap.
  const std::uint64_t limit = budget_bytes_ - std::min(budget_bytes_ / 2, largest_bytes_);
  return bytes_ <= limit ? bytes_ : limit - limit / slack_share;
}

std::uint64_t MemoryAccount::over_budget_bytes() const {
  return budget_bytes_ > 0 && peak_bytes_ > budget_bytes_ ? peak_bytes_ - budget_bytes_ : 0;
}

}  // namespace enfilade
