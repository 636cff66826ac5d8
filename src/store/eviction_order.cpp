#include "store/eviction_order.hpp"

#include <algorithm>

namespace enfilade {

void EvictionOrder::set(std::vector<EvictionCandidate> candidates, std::uint64_t good_for_bytes) {
  candidates_ = std::move(candidates);
  std::make_heap(candidates_.begin(), candidates_.end());
  good_for_bytes_ = good_for_bytes;
}

EvictionCandidate EvictionOrder::take() {
  std::pop_heap(candidates_.begin(), candidates_.end());
  const EvictionCandidate candidate = candidates_.back();
  candidates_.pop_back();
  return candidate;
}

void EvictionOrder::note_evicted(std::uint64_t bytes) {
  good_for_bytes_ -= std::min(good_for_bytes_, bytes);
}

}  // namespace enfilade
