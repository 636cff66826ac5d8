// The order in which clusters leave a rank's memory: by how far ahead their next use lies (Belady,
// A study of replacement algorithms for a virtual-storage computer, 1966).
#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "base/ids.hpp"

namespace enfilade {

/// A part of a cluster that can go: its links, or all the rest of it.
struct EvictionCandidate {
  std::uint64_t turns = 0;  ///< until it is used again; 0 = in the gather at hand
  bool links = false;
  ClusterId cluster;
  auto operator<=>(const EvictionCandidate&) const = default;
};

/// A list that was made a while ago serves on, since a candidate whose use was far ahead then is
/// far from its use still; but not for more evictions than it was made for.
class EvictionOrder {
 public:
  bool out_of_date() const { return candidates_.empty() || good_for_bytes_ == 0; }
  bool empty() const { return candidates_.empty(); }
  /// The list is good for evictions of so many bytes.
  void set(std::vector<EvictionCandidate> candidates, std::uint64_t good_for_bytes);
  /// Takes the one from the list whose use lies farthest ahead.
  EvictionCandidate take();
  void note_evicted(std::uint64_t bytes);

 private:
  std::vector<EvictionCandidate> candidates_;  ///< a heap
  std::uint64_t good_for_bytes_ = 0;
};

}  // namespace enfilade
