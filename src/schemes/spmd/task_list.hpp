// A rank's receiving clusters: its CYCLE, gone through once in each iteration. Stolen clusters
// leave the victim's CYCLE and are inserted into the thief's (§3.3.3).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/ids.hpp"
#include "schemes/spmd/next_uses.hpp"
#include "tour/order.hpp"

namespace enfilade {

class TaskList {
 public:
  /// `cost` must outlive the list.
  TaskList(std::vector<ClusterId> own, const VisibilityCost& cost, std::unique_ptr<Order> order);

  /// Begins an iteration at the start of CYCLE; clusters adopted in the last one are inserted where
  /// they cost least.
  void start();
  /// Returns the next receiving cluster; none when all have had their turn.
  std::optional<ClusterId> next();
  /// Gives a waiting cluster to a thief with these clusters in its memory: the one whose visible
  /// clusters cost the thief least to load, of equals the last in CYCLE, which is farthest from the
  /// cluster that this rank works on.
  std::optional<ClusterId> give(std::span<const ClusterId> resident);
  /// Adds a stolen cluster, which belongs to this rank from now on: S = S + C of figure 2.
  void adopt(ClusterId cluster) { adopted_.push_back(cluster); }
  /// Reports a gather of this rank and the power by which it changed the receiver's light; some
  /// orders use it.
  void gathered(ClusterId receiver, double change_power) {
    order_->gathered(receiver, change_power);
  }

  std::size_t waiting() const { return turns_.size() - done_; }
  const Cycle& cycle() const { return cycle_; }
  /// Returns the number of turns from now until a cluster (or its links) is used again
  /// (NextUses::of).
  std::uint64_t next_use(ClusterId cluster, bool links) { return uses_.of(cluster, links); }

 private:
  void insert(ClusterId cluster, std::vector<ClusterId>& order) const;

  const VisibilityCost* cost_;
  std::unique_ptr<Order> order_;
  Cycle cycle_;
  std::vector<ClusterId> turns_;  ///< of this iteration: CYCLE, or its permutation by the order
  std::vector<ClusterId> adopted_;
  std::size_t done_ = 0;
  NextUses uses_;
};

}  // namespace enfilade
