// Memory cut into small pieces, all alike, so that no hole is too small to be used (§4.4).
#pragma once

#include <cstdint>
#include <vector>

namespace enfilade {

struct AddressRange {
  std::uint64_t address = 0, bytes = 0;
};

/// Pieces are taken from pages that hold others already, else from the lowest empty page: no page
/// is begun as long as one has room, so that never more pages are in use than the pieces filled
/// when they were most.
class SimulatedPieces {
 public:
  static constexpr std::uint64_t page_bytes = 4096;
  static constexpr std::uint64_t piece_bytes = 256;

  /// Takes as many pieces as `bytes` (a multiple of piece_bytes) need; appends where they lie, what
  /// lies side by side as one range.
  void take(std::uint64_t bytes, std::vector<AddressRange>& ranges);
  void free(AddressRange range);
  bool page_empty(std::size_t page) const { return used_[page] == 0; }
  /// Behind the last piece that was ever taken.
  std::uint64_t extent_bytes() const { return extent_bytes_; }

 private:
  /// Pages, and quickly the lowest of them.
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
