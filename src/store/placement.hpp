// Where a rank's clusters lie in a memory of its budget's size, and what of that memory an
// operating system would swap (§4.4).
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace enfilade {

/// own     the memory is cut into small pieces, all alike; a block takes any that are free, so that
/// no
///         hole is too small to be used, and free pages go back to the system (in the real heap: by
///         malloc_trim)
/// malloc  a general-purpose heap: a block is one piece, in the smallest hole that it fits into,
/// else at
///         the end; neighbouring holes become one; only what is free at the end goes back
enum class MemoryManager { own, malloc };
/// Throws InputError for a name that is neither.
MemoryManager memory_manager(const std::string& name);
const char* name_of(MemoryManager manager);

struct PlacementCount {
  std::uint64_t extent_bytes = 0;   ///< largest address in use at any time: what the blocks and the
                                    ///< holes between them took
  std::uint64_t swapped_bytes = 0;  ///< moved out of the memory, and in again where needed
};

/// The paper saw its hosts swap though what was resident would have fitted, since malloc() and
/// free() left holes. Here both ways of placing are given the same blocks, as the solver makes,
/// grows and drops them, and the same physical memory with the system's rule: when it is full, the
/// pages go that were not used for longest. A page in a hole of the heap is dirty and goes the same
/// way. A cluster is one block a part, where the real heap has a vector a patch: that is kind to
/// malloc.
class Placement {
 public:
  static constexpr std::uint64_t page_bytes = 4096;
  static constexpr std::uint64_t piece_bytes = 256;  ///< of own

  Placement(MemoryManager manager, std::uint64_t memory_bytes);

  /// A block; 0 is none.
  using Block = std::uint32_t;
  /// What a block of so many bytes counts for with who does the accounts: own knows its pieces, a
  /// user of malloc() only what was asked for.
  std::uint64_t accounted(std::uint64_t bytes) const;
  /// Makes a block (0 before), gives it another size and so another place, or drops it (bytes = 0).
  void resize(Block& block, std::uint64_t bytes);
  /// Its pages are read or written. Returns the bytes that had to be swapped for that.
  std::uint64_t use(Block block);

  const PlacementCount& count() const { return count_; }

 private:
  struct Piece {
    std::uint64_t address = 0, bytes = 0;
  };
  struct Page {
    std::uint64_t last_use = 0;
    bool in_memory = false, on_disk = false;
  };
  Piece take_hole(std::uint64_t bytes);
  void free(Piece piece);
  void add_hole(std::uint64_t address, std::uint64_t bytes);
  void remove_hole(std::map<std::uint64_t, std::uint64_t>::iterator hole);
  /// Whole pages between these addresses are the system's again.
  void give_back(std::uint64_t from, std::uint64_t to);
  std::uint64_t swap_oldest();

  MemoryManager manager_;
  std::uint64_t frames_;  ///< pages that the memory holds
  std::uint64_t clock_ = 0, in_memory_ = 0;
  std::uint64_t end_ = 0;                         ///< of what was ever taken and not given back
  std::map<std::uint64_t, std::uint64_t> holes_;  ///< address -> bytes
  std::set<std::pair<std::uint64_t, std::uint64_t>> holes_by_size_;  ///< bytes, address
  std::vector<Page> pages_;
  std::vector<std::vector<Piece>> blocks_{1};
  std::vector<Block> unused_;
  PlacementCount count_;
};

}  // namespace enfilade
