// A model of a memory that is cut into small pieces of one size, so that no hole is too small to be
// used (§4.4). It holds addresses, not memory.
#pragma once

#include <cstdint>
#include <vector>

namespace enfilade {

struct AddressRange {
  std::uint64_t address = 0, bytes = 0;
};

/// Pieces are taken from the lowest page that is partly used, else from the lowest empty page. So
/// the pages ever used are no more than the pieces filled at their peak.
class SimulatedPieces {
 public:
  static constexpr std::uint64_t page_bytes = 4096;
  static constexpr std::uint64_t piece_bytes = 256;

  /// Takes pieces for `bytes` (a multiple of piece_bytes) and appends their addresses; neighbouring
  /// pieces become one range.
  void take(std::uint64_t bytes, std::vector<AddressRange>& ranges);
  void free(AddressRange range);
  bool page_empty(std::size_t page) const { return used_[page] == 0; }
  /// Returns the first address behind the last piece that was ever taken.
  std::uint64_t extent_bytes() const { return extent_bytes_; }

 private:
  /// A set of pages whose lowest one is found quickly.
  class PageSet {
   public:
    static constexpr std::size_t none = ~std::size_t{0};
    void insert(std::size_t page);
    void erase(std::size_t page);
    std::size_t lowest();

   private:
    std::vector<std::uint64_t> words_;
    std::size_t first_ = 0;  ///< no word before it has a page
  };
  std::size_t page_with_room();
  void sort_in(std::size_t page);

  std::vector<std::uint16_t> used_;  ///< by page, a bit a piece
  PageSet partly_used_, empty_;      ///< pages below used_.size() that have room
  std::uint64_t extent_bytes_ = 0;
};

}  // namespace enfilade
