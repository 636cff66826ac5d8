#include "store/simulated_pieces.hpp"

#include <algorithm>
#include <bit>

namespace enfilade {
namespace {
constexpr unsigned pieces_a_page = SimulatedPieces::page_bytes / SimulatedPieces::piece_bytes;
constexpr std::uint16_t full_page = 0xFFFF;
static_assert(pieces_a_page == 16, "a bit of used_ for each");
}  // namespace

void SimulatedPieces::PageSet::insert(std::size_t page) {
  words_.resize(std::max(words_.size(), page / 64 + 1), 0);
  words_[page / 64] |= std::uint64_t{1} << (page % 64);
  first_ = std::min(first_, page / 64);
}

void SimulatedPieces::PageSet::erase(std::size_t page) {
  if (page / 64 < words_.size()) words_[page / 64] &= ~(std::uint64_t{1} << (page % 64));
}

std::size_t SimulatedPieces::PageSet::lowest() {
  while (first_ < words_.size() && words_[first_] == 0) ++first_;
  if (first_ == words_.size()) return none;
  return 64 * first_ + static_cast<std::size_t>(std::countr_zero(words_[first_]));
}

std::size_t SimulatedPieces::page_with_room() {
  if (const std::size_t page = partly_used_.lowest(); page != PageSet::none) return page;
  if (const std::size_t page = empty_.lowest(); page != PageSet::none) return page;
  used_.push_back(0);
  return used_.size() - 1;
}

void SimulatedPieces::sort_in(std::size_t page) {
  const std::uint16_t used = used_[page];
  used == 0 ? empty_.insert(page) : empty_.erase(page);
  used != 0 && used != full_page ? partly_used_.insert(page) : partly_used_.erase(page);
}

void SimulatedPieces::take(std::uint64_t bytes, std::vector<AddressRange>& ranges) {
  for (std::uint64_t pieces = bytes / piece_bytes; pieces > 0;) {
    const std::size_t page = page_with_room();
    for (; pieces > 0 && used_[page] != full_page; --pieces) {
      const int piece = std::countr_one(used_[page]);
      used_[page] = static_cast<std::uint16_t>(used_[page] | (1u << piece));
      const std::uint64_t address =
          page * page_bytes + static_cast<std::uint64_t>(piece) * piece_bytes;
      if (!ranges.empty() && ranges.back().address + ranges.back().bytes == address) {
        ranges.back().bytes += piece_bytes;
      } else {
        ranges.push_back({address, piece_bytes});
      }
      extent_bytes_ = std::max(extent_bytes_, address + piece_bytes);
    }
    sort_in(page);
  }
}

void SimulatedPieces::free(AddressRange range) {
  for (std::uint64_t at = range.address; at < range.address + range.bytes;) {
    const std::size_t page = at / page_bytes;
    const std::uint64_t end = std::min(range.address + range.bytes, (page + 1) * page_bytes);
    const auto count = static_cast<unsigned>((end - at) / piece_bytes);
    const auto first = static_cast<unsigned>(at % page_bytes / piece_bytes);
    const unsigned pieces = ((1u << count) - 1u) << first;
    used_[page] = static_cast<std::uint16_t>(used_[page] & ~pieces);
    sort_in(page);
    at = end;
  }
}

}  // namespace enfilade
