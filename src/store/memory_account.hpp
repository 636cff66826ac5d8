// How much of its memory budget a rank's clusters take, and what the memory manager makes of it
// (§4.4).
#pragma once

#include <cstdint>

#include "base/ids.hpp"
#include "machine/machine.hpp"
#include "store/simulated_placement.hpp"

namespace enfilade {

/// The memory of one cluster: of what it shoots with (geometry and patches), and of its links.
struct ClusterMemory {
  std::uint64_t shooter_bytes = 0, links_bytes = 0;
  SimulatedPlacement::Block shooter_block = 0, links_block = 0;
  std::uint64_t bytes() const { return shooter_bytes + links_bytes; }
};

/// Sizes are those that the machine counts (Machine::record_bytes). Where there is a budget, the
/// same blocks are placed in a simulated memory of its size.
class MemoryAccount {
 public:
  /// budget_bytes 0 = no limit.
  MemoryAccount(Machine& machine, std::uint64_t budget_bytes, MemoryManager manager)
      : machine_(machine),
        budget_bytes_(budget_bytes),
        manager_(manager),
        placement_(manager, budget_bytes) {}

  /// The cluster takes so much from now on.
  void resize(ClusterMemory& memory, std::uint64_t shooter_bytes, std::uint64_t links_bytes);
  /// A gather uses the cluster, perhaps with its links; what the system has to swap for that takes
  /// its time.
  void use(ClusterId id, const ClusterMemory& memory, bool links);
  /// Returns freed memory to the system, once an eighth of the budget was freed by evictions: it
  /// lies scattered in the allocator's heap and would still count as resident (§4.4).
  void return_freed(std::uint64_t evicted_bytes);

  std::uint64_t bytes() const { return bytes_; }
  std::uint64_t budget_bytes() const { return budget_bytes_; }
  /// Returns the number of bytes down to which to evict; `bytes()` or more where nothing has to go.
  std::uint64_t goal_bytes() const;

  std::uint64_t peak_bytes() const { return peak_bytes_; }
  /// Returns the most by which the budget was passed.
  std::uint64_t over_budget_bytes() const;
  const SimulatedPlacementCount& placement() const { return placement_.count(); }

 private:
  Machine& machine_;
  std::uint64_t budget_bytes_;
  MemoryManager manager_;
  SimulatedPlacement placement_;
  std::uint64_t bytes_ = 0, peak_bytes_ = 0;
  std::uint64_t largest_bytes_ = 0;  ///< that a cluster has taken so far: room for the next one
  std::uint64_t evicted_bytes_ = 0;  ///< since memory was returned to the system
};

}  // namespace enfilade
