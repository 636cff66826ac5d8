#include "store/simulated_placement.hpp"

#include <algorithm>

#include "base/error.hpp"

namespace enfilade {
namespace {
/// A 32nd of the memory is swapped out beyond the need, as systems do, so that not every new page
/// makes another one go.
constexpr std::uint64_t swap_slack_share = 32;
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

SimulatedPlacement::SimulatedPlacement(MemoryManager manager, std::uint64_t memory_bytes)
    : manager_(manager), frames_(std::max<std::uint64_t>(1, memory_bytes / page_bytes)) {}

std::uint64_t SimulatedPlacement::accounted(std::uint64_t bytes) const {
  constexpr std::uint64_t piece = SimulatedPieces::piece_bytes;
  return manager_ == MemoryManager::own ? (bytes + piece - 1) / piece * piece : bytes;
}

SimulatedPlacement::Block SimulatedPlacement::new_block() {
  if (unused_.empty()) {
    unused_.push_back(static_cast<Block>(blocks_.size()));
    blocks_.emplace_back();
  }
  const Block block = unused_.back();
  unused_.pop_back();
  return block;
}

void SimulatedPlacement::take(std::uint64_t bytes, std::vector<AddressRange>& ranges) {
  if (bytes == 0) return;
  if (manager_ == MemoryManager::own) {
    pieces_.take(bytes, ranges);
  } else {
    ranges.push_back(heap_.take(bytes));
  }
  const std::uint64_t end = manager_ == MemoryManager::own ? pieces_.extent_bytes() : heap_.end();
  count_.extent_bytes = std::max(count_.extent_bytes, end);
  pages_.resize(std::max<std::size_t>(pages_.size(), (end + page_bytes - 1) / page_bytes));
}

template <class Visit>
void SimulatedPlacement::for_pages(const AddressRange& range, Visit visit) {
  const std::uint64_t last = (range.address + range.bytes - 1) / page_bytes;
  for (std::uint64_t p = range.address / page_bytes; p <= last; ++p) visit(p);
}

void SimulatedPlacement::free(const AddressRange& range, std::uint64_t last_use) {
  for_pages(range,
            [&](std::size_t p) { pages_[p].last_use = std::max(pages_[p].last_use, last_use); });
  if (manager_ == MemoryManager::own) {
    pieces_.free(range);
    for_pages(range, [this](std::size_t p) {
      if (pieces_.page_empty(p)) give_back(p);
    });
    return;
  }
  const std::uint64_t end = heap_.end();
  heap_.free(range);
  for (std::uint64_t p = (heap_.end() + page_bytes - 1) / page_bytes;
       p < (end + page_bytes - 1) / page_bytes; ++p) {
    give_back(p);
  }
}

void SimulatedPlacement::give_back(std::size_t page) {
  if (pages_[page].in_memory) {
    --in_memory_;
  } else if (pages_[page].on_disk) {
    --swapped_out_;
  }
  pages_[page] = {};
}

/// In a heap the old block is freed after the new one was taken, as with a vector that grows; own
/// pieces stay where they are.
void SimulatedPlacement::resize(Block& block, std::uint64_t bytes) {
  BlockPlace old;
  if (block != 0) {
    old = std::move(blocks_[block]);
    blocks_[block] = {};
    unused_.push_back(block);
    block = 0;
  }
  BlockPlace place;
  std::uint64_t missing = accounted(bytes);
  std::size_t kept = 0;
  if (manager_ == MemoryManager::own) {
    while (kept < old.ranges.size() && missing > 0) {
      AddressRange& range = old.ranges[kept];
      const std::uint64_t part = std::min(missing, range.bytes);
      place.ranges.push_back({range.address, part});
      missing -= part;
      if (part == range.bytes) ++kept;
      range = {range.address + part, range.bytes - part};
    }
  }
  take(missing, place.ranges);
  for (; kept < old.ranges.size(); ++kept) free(old.ranges[kept], old.last_use);
  if (place.ranges.empty()) return;
  block = new_block();
  blocks_[block] = std::move(place);
  blocks_[block].last_use = ++clock_;
  touch(blocks_[block]);
}

std::uint64_t SimulatedPlacement::use(Block block) {
  blocks_[block].last_use = ++clock_;
  return swapped_out_ == 0 ? 0 : touch(blocks_[block]);
}

std::uint64_t SimulatedPlacement::touch(const BlockPlace& block) {
  std::uint64_t swapped = 0;
  for (const AddressRange& range : block.ranges) {
    for_pages(range, [&](std::size_t p) {
      Page& page = pages_[p];
      if (page.in_memory) return;
      page.in_memory = true;
      ++in_memory_;
      if (!page.on_disk) return;
      --swapped_out_;
      swapped += page_bytes;
    });
  }
  if (in_memory_ > frames_) swapped += swap_oldest();
  count_.swapped_bytes += swapped;
  return swapped;
}

std::uint64_t SimulatedPlacement::swap_oldest() {
  for (const BlockPlace& block : blocks_) {
    for (const AddressRange& range : block.ranges) {
      for_pages(range, [&](std::size_t p) {
        pages_[p].last_use = std::max(pages_[p].last_use, block.last_use);
      });
    }
  }
  std::vector<std::pair<std::uint64_t, std::uint64_t>> used;  // when, page
  for (std::size_t p = 0; p < pages_.size(); ++p) {
    if (pages_[p].in_memory && pages_[p].last_use < clock_)
      used.emplace_back(pages_[p].last_use, p);
  }
  const std::size_t excess =
      static_cast<std::size_t>(in_memory_ - frames_ + frames_ / swap_slack_share);
  const std::size_t count = std::min(used.size(), excess);
  std::nth_element(used.begin(), used.begin() + static_cast<std::ptrdiff_t>(count), used.end());
  for (std::size_t i = 0; i < count; ++i) {
    Page& page = pages_[used[i].second];
    page.in_memory = false;
    page.on_disk = true;
  }
  in_memory_ -= count;
  swapped_out_ += count;
  return count * page_bytes;
}

}  // namespace enfilade
