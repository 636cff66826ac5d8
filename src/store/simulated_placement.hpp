// A simulation of a memory of a rank's budget: where its clusters would lie, and how much of it an
// operating system would swap (§4.4).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "store/simulated_heap.hpp"

namespace enfilade {

/// own     small pieces (simulated_pieces.hpp): a block takes any free pieces, and free pages go
///         back to the system (in the real heap: by malloc_trim)
/// malloc  a general-purpose heap (simulated_heap.hpp)
enum class MemoryManager { own, malloc };
/// Throws InputError unless the name is `own` or `malloc`.
MemoryManager memory_manager(const std::string& name);
const char* name_of(MemoryManager manager);

struct SimulatedPlacementCount {
  std::uint64_t extent_bytes = 0;   ///< largest address in use at any time: blocks and the holes
                                    ///< between them
  std::uint64_t swapped_bytes = 0;  ///< moved out of the memory, and in again
};

/// The paper's hosts swapped although their resident clusters would have fitted, since malloc() and
/// free() left holes. Here both memory managers place the same blocks, as the solver makes, grows
/// and drops them, in the same physical memory with the system's rule: when the memory is full, the
/// least recently used pages are swapped out. A page in a hole of the heap is dirty and is swapped
/// out as well. Each of a cluster's two parts is one block here, where the real heap has a vector
/// for each patch: the simulation favours malloc.
class SimulatedPlacement {
 public:
  static constexpr std::uint64_t page_bytes = SimulatedPieces::page_bytes;

  SimulatedPlacement(MemoryManager manager, std::uint64_t memory_bytes);

  /// A block; 0 is none.
  using Block = std::uint32_t;
  /// Returns the bytes of the budget that a block of so many bytes takes: whole pieces (own), or
  /// the bytes that were asked for (malloc).
  std::uint64_t accounted(std::uint64_t bytes) const;
  /// Makes a block (0 before), gives it another size and so another place, or drops it (bytes = 0).
  void resize(Block& block, std::uint64_t bytes);
  /// The block's pages are read or written. Returns the bytes that had to be swapped for that.
  std::uint64_t use(Block block);

  const SimulatedPlacementCount& count() const { return count_; }

 private:
  struct BlockPlace {
    std::vector<AddressRange> ranges;
    std::uint64_t last_use = 0;
  };
  struct Page {
    std::uint64_t last_use = 0;  ///< by blocks that were freed; other blocks have their own
    bool in_memory = false, on_disk = false;
  };
  Block new_block();
  /// Calls visit(page) for all pages of the range.
  template <class Visit>
  void for_pages(const AddressRange& range, Visit visit);
  void take(std::uint64_t bytes, std::vector<AddressRange>& ranges);
  void free(const AddressRange& range, std::uint64_t last_use);
  /// Returns the page to the system.
  void give_back(std::size_t page);
  /// Brings the block's pages into the memory. Returns the bytes swapped for that.
  std::uint64_t touch(const BlockPlace& block);
  std::uint64_t swap_oldest();

  MemoryManager manager_;
  std::uint64_t frames_;  ///< pages that the memory holds
  std::uint64_t clock_ = 0, in_memory_ = 0, swapped_out_ = 0;
  SimulatedPieces pieces_;  ///< of own
  SimulatedHeap heap_;      ///< of malloc
  std::vector<Page> pages_;
  std::vector<BlockPlace> blocks_{1};
  std::vector<Block> unused_;
  SimulatedPlacementCount count_;
};

}  // namespace enfilade
