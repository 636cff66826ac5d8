// OVG and CYCLE: the order in which a rank's clusters gather (§3.2).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/ids.hpp"
#include "visibility/cluster_graph.hpp"

namespace enfilade {

/// The cost of going from one receiving cluster to the next, in bytes: OVG's edges (§3.2).
/// cost(C1, C2) = bytes of C2's receiver part and of the clusters visible to C2 that are neither C1
/// nor visible to C1, when `memory_bytes` holds all that C2 needs; bytes that do not fit are read
/// again.
class VisibilityCost {
 public:
  /// bytes[c]: bytes of cluster c as a shooter (geometry and patches). receiver_bytes[c]: its
  /// further bytes as a receiver (links), read at each of its turns; empty = none.
  VisibilityCost(const ClusterGraph& graph, std::vector<std::uint64_t> bytes,
                 std::uint64_t memory_bytes, std::vector<std::uint64_t> receiver_bytes = {});
  std::uint64_t between(ClusterId from, ClusterId to) const;
  /// Returns for each receiver the bytes that it needs of clusters that are not `resident` (§3.3.3:
  /// by these the victim chooses the cluster that it gives away).
  std::vector<std::uint64_t> given(std::span<const ClusterId> resident,
                                   std::span<const ClusterId> receivers) const;
  /// Returns the bytes that `receiver` needs when nothing is in memory.
  std::uint64_t needed(ClusterId receiver) const { return needed_[receiver.index()]; }
  const ClusterGraph& graph() const { return *graph_; }

 private:
  /// 64 clusters with neighbouring ids, as bits: a room's clusters are a few words.
  struct Word {
    std::uint32_t index = 0;
    std::uint64_t bits = 0, bytes = 0;
  };
  std::span<const Word> words(std::size_t cluster) const {
    return {words_.data() + first_word_[cluster], words_.data() + first_word_[cluster + 1]};
  }
  std::uint64_t bytes_of(std::uint32_t index, std::uint64_t bits) const;
  /// Returns the bytes of the word's clusters that are not in `held`.
  std::uint64_t bytes_without(const Word& word, std::uint64_t held) const;
  std::uint64_t receiver_bytes(std::size_t cluster) const {
    return receiver_bytes_.empty() ? 0 : receiver_bytes_[cluster];
  }

  const ClusterGraph* graph_;
  std::vector<std::uint64_t> bytes_, receiver_bytes_;
  std::uint64_t memory_bytes_;
  std::vector<std::size_t> first_word_;
  std::vector<Word> words_;  ///< by cluster: the cluster itself and all that it sees
  std::vector<std::uint64_t> needed_;
};

/// Returns the bytes of one round of a closed tour.
std::uint64_t cost_of_round(const std::vector<ClusterId>& order, const VisibilityCost& cost);

/// CYCLE: a closed tour through a rank's clusters, traversed once per iteration.
class Cycle {
 public:
  Cycle() = default;
  /// `order` as Order::arrange (tour/order.hpp) returns it.
  Cycle(std::vector<ClusterId> order, const VisibilityCost& cost);

  const std::vector<ClusterId>& order() const { return order_; }
  /// Returns the bytes of one round. A cycle of one cluster costs the bytes of it that do not fit
  /// into memory.
  std::uint64_t cost_bytes() const { return cost_bytes_; }
  /// Links predecessor and successor together (§3.3.3). Does nothing for a cluster that is not in
  /// the cycle.
  void remove(ClusterId cluster, const VisibilityCost& cost);

 private:
  std::vector<ClusterId> order_;
  std::uint64_t cost_bytes_ = 0;
};

}  // namespace enfilade
