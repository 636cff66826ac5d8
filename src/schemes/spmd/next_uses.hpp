// When a rank will use each cluster again, by its CYCLE: the cluster whose next use is farthest in
// the future is evicted first (L. Belady, 1966).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "visibility/cluster_graph.hpp"

namespace enfilade {

class NextUses {
 public:
  /// `graph` must outlive it.
  explicit NextUses(const ClusterGraph& graph) : graph_(&graph) {}

  /// Begins a round of these receivers, in this order.
  void start(std::span<const ClusterId> turns);
  /// Records that this receiver has been gathered for; its turn comes again in the next round.
  void done(ClusterId receiver);
  /// Records that this receiver belongs to another rank from now on.
  void gave(ClusterId receiver);
  /// Returns the number of turns from now until a cluster (or its links) is used, in this round or
  /// the next; a cluster that this rank does not use comes after all others.
  std::uint64_t of(ClusterId cluster, bool links);

 private:
  enum class Turn : char { waiting, done, gone };
  static constexpr std::uint32_t nowhere = 0xFFFFFFFFu;
  void list_uses();
  std::uint64_t never() const { return 2 * turns_.size() + 1; }
  std::uint64_t turns_until(std::uint32_t turn) const;

  const ClusterGraph* graph_;
  std::vector<ClusterId> turns_;
  std::vector<Turn> state_;           ///< of each turn
  std::vector<std::uint32_t> place_;  ///< of each cluster among the turns
  std::uint64_t past_ = 0;            ///< turns done
  // Made at the first call of of() in a round. The turns that use cluster c, ascending, are
  // uses_[first_[c]] to uses_[first_[c + 1] - 1]; entries before next_[c] are already done or given
  // away.
  std::vector<std::uint32_t> uses_, first_, next_;
};

}  // namespace enfilade
