#include "store/simulated_heap.hpp"

#include <iterator>

namespace enfilade {
namespace {
/// A block has its size before it, and its address is a multiple of this, as with glibc.
constexpr std::uint64_t header_bytes = 16;
}  // namespace

void SimulatedHeap::add_hole(std::uint64_t address, std::uint64_t bytes) {
  holes_[address] = bytes;
  holes_by_size_.insert({bytes, address});
}

void SimulatedHeap::remove_hole(std::map<std::uint64_t, std::uint64_t>::iterator hole) {
  holes_by_size_.erase({hole->second, hole->first});
  holes_.erase(hole);
}

/// The smallest hole that is large enough, and of equals the lowest; else the end.
AddressRange SimulatedHeap::take(std::uint64_t bytes) {
  bytes = (bytes + 2 * header_bytes - 1) / header_bytes * header_bytes;
  const auto fits = holes_by_size_.lower_bound({bytes, 0});
  if (fits == holes_by_size_.end()) {
    const AddressRange range{end_, bytes};
    end_ += bytes;
    return range;
  }
  const auto [size, address] = *fits;
  remove_hole(holes_.find(address));
  if (size > bytes) add_hole(address + bytes, size - bytes);
  return {address, bytes};
}

void SimulatedHeap::free(AddressRange range) {
  const auto after = holes_.lower_bound(range.address);
  if (after != holes_.end() && after->first == range.address + range.bytes) {
    range.bytes += after->second;
    remove_hole(after);
  }
  const auto next = holes_.lower_bound(range.address);
  if (next != holes_.begin()) {
    const auto before = std::prev(next);
    if (before->first + before->second == range.address) {
      range = {before->first, before->second + range.bytes};
      remove_hole(before);
    }
  }
  if (range.address + range.bytes == end_) {
    end_ = range.address;
  } else {
    add_hole(range.address, range.bytes);
  }
}

}  // namespace enfilade
