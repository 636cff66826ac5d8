// A model of a general-purpose heap: which holes malloc() and free() leave (§4.4). It holds
// addresses, not memory.
#pragma once

#include <cstdint>
#include <map>
#include <set>

#include "store/simulated_pieces.hpp"

namespace enfilade {

/// Best fit with coalescing: a block goes into the smallest hole that it fits into, else to the
/// end; neighbouring holes become one; only a free range at the end goes back to the system.
class SimulatedHeap {
 public:
  AddressRange take(std::uint64_t bytes);
  void free(AddressRange range);
  /// Returns the first address behind the last block.
  std::uint64_t end() const { return end_; }

 private:
  void add_hole(std::uint64_t address, std::uint64_t bytes);
  void remove_hole(std::map<std::uint64_t, std::uint64_t>::iterator hole);

  std::uint64_t end_ = 0;
  std::map<std::uint64_t, std::uint64_t> holes_;                     ///< address -> bytes
  std::set<std::pair<std::uint64_t, std::uint64_t>> holes_by_size_;  ///< bytes, address
};

}  // namespace enfilade
