#include "store/placement.hpp"

#include <algorithm>
#include <iterator>

#include "base/error.hpp"

namespace enfilade {
namespace {
/// Of a heap's block: its size before it, and addresses that are multiples of this.
constexpr std::uint64_t heap_header_bytes = 16;
std::uint64_t round_up(std::uint64_t bytes, std::uint64_t unit) {
  return (bytes + unit - 1) / unit * unit;
}
}  // namespace

const char* name_of(MemoryManager manager) {
  return manager == MemoryManager::own ? "own" : "malloc";
}

MemoryManager memory_manager(const std::string& name) {
  for (const MemoryManager manager : {MemoryManager::own, MemoryManager::malloc}) {
    if (name == name_of(manager)) return manager;
  }
  throw InputError("--memory-manager", "'" + name + "'", "no memory manager has this name",
                   "use own or malloc");
}

Placement::Placement(MemoryManager manager, std::uint64_t memory_bytes)
    : manager_(manager), frames_(std::max<std::uint64_t>(1, memory_bytes / page_bytes)) {}

void Placement::add_hole(std::uint64_t address, std::uint64_t bytes) {
  holes_[address] = bytes;
  holes_by_size_.insert({bytes, address});
}

void Placement::remove_hole(std::map<std::uint64_t, std::uint64_t>::iterator hole) {
  holes_by_size_.erase({hole->second, hole->first});
  holes_.erase(hole);
}

/// The smallest hole that is large enough, and of equals the lowest; else the end.
Placement::Piece Placement::take_hole(std::uint64_t bytes) {
  const auto fits = holes_by_size_.lower_bound({bytes, 0});
  if (fits == holes_by_size_.end()) {
    const Piece piece{end_, bytes};
    end_ += bytes;
    return piece;
  }
  const auto [size, address] = *fits;
  remove_hole(holes_.find(address));
  if (size > bytes) add_hole(address + bytes, size - bytes);
  return {address, bytes};
}

void Placement::free(Piece piece) {
  const auto after = holes_.lower_bound(piece.address);
  if (after != holes_.end() && after->first == piece.address + piece.bytes) {
    piece.bytes += after->second;
    remove_hole(after);
  }
  const auto next = holes_.lower_bound(piece.address);
  if (next != holes_.begin()) {
    const auto before = std::prev(next);
    if (before->first + before->second == piece.address) {
      piece = {before->first, before->second + piece.bytes};
      remove_hole(before);
    }
  }
  if (piece.address + piece.bytes == end_) {
    give_back(piece.address, round_up(end_, page_bytes));
    end_ = piece.address;
  } else {
    add_hole(piece.address, piece.bytes);
    if (manager_ == MemoryManager::own) give_back(piece.address, piece.address + piece.bytes);
  }
}

void Placement::give_back(std::uint64_t from, std::uint64_t to) {
  for (std::uint64_t p = round_up(from, page_bytes) / page_bytes; p < to / page_bytes; ++p) {
    in_memory_ -= pages_[p].in_memory ? 1 : 0;
    pages_[p] = {};
  }
}

std::uint64_t Placement::accounted(std::uint64_t bytes) const {
  return manager_ == MemoryManager::own ? round_up(bytes, piece_bytes) : bytes;
}

/// The old block goes when the new one is there, as with a vector that grows; own pieces stay.
void Placement::resize(Block& block, std::uint64_t bytes) {
  std::vector<Piece> pieces, old;
  if (block != 0) {
    old = std::move(blocks_[block]);
    unused_.push_back(block);
    block = 0;
  }
  if (manager_ == MemoryManager::own) {
    const std::size_t count = (bytes + piece_bytes - 1) / piece_bytes;
    const std::size_t kept = std::min(count, old.size());
    pieces.assign(old.begin(), old.begin() + static_cast<std::ptrdiff_t>(kept));
    old.erase(old.begin(), old.begin() + static_cast<std::ptrdiff_t>(kept));
    while (pieces.size() < count) pieces.push_back(take_hole(piece_bytes));
  } else if (bytes > 0) {
    pieces = {take_hole(round_up(bytes + heap_header_bytes, heap_header_bytes))};
  }
  count_.extent_bytes = std::max(count_.extent_bytes, end_);
  pages_.resize(std::max<std::size_t>(pages_.size(), round_up(end_, page_bytes) / page_bytes));
  for (const Piece& piece : old) free(piece);
  if (pieces.empty()) return;
  if (unused_.empty()) {
    unused_.push_back(static_cast<Block>(blocks_.size()));
    blocks_.emplace_back();
  }
  block = unused_.back();
  unused_.pop_back();
  blocks_[block] = std::move(pieces);
  use(block);
}

std::uint64_t Placement::use(Block block) {
  ++clock_;
  std::uint64_t swapped = 0;
  for (const Piece& piece : blocks_[block]) {
    const std::uint64_t last = (piece.address + piece.bytes - 1) / page_bytes;
    for (std::uint64_t p = piece.address / page_bytes; p <= last; ++p) {
      Page& page = pages_[p];
      page.last_use = clock_;
      if (page.in_memory) continue;
      page.in_memory = true;
      ++in_memory_;
      if (page.on_disk) swapped += page_bytes;
    }
  }
  if (in_memory_ > frames_) swapped += swap_oldest();
  count_.swapped_bytes += swapped;
  return swapped;
}

/// A little more than needed, as systems do.
std::uint64_t Placement::swap_oldest() {
  std::vector<std::pair<std::uint64_t, std::uint64_t>> used;  // when, page
  for (std::size_t p = 0; p < pages_.size(); ++p) {
    if (pages_[p].in_memory && pages_[p].last_use < clock_)
      used.emplace_back(pages_[p].last_use, p);
  }
  const std::size_t excess = static_cast<std::size_t>(in_memory_ - frames_ + frames_ / 32);
  const std::size_t count = std::min(used.size(), excess);
  std::nth_element(used.begin(), used.begin() + static_cast<std::ptrdiff_t>(count), used.end());
  for (std::size_t i = 0; i < count; ++i) {
    Page& page = pages_[used[i].second];
    page.in_memory = false;
    page.on_disk = true;
  }
  in_memory_ -= count;
  return count * page_bytes;
}

}  // namespace enfilade
