// RequestForCluster of figure 4: a rank that has run out of work requests a cluster from the other
// ranks, one by one.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "schemes/spmd/progress_engine.hpp"

namespace enfilade {

class WorkStealingClient {
 public:
  WorkStealingClient(Communicator& communicator, Machine& machine, ProgressEngine& engine);
  void start(int iteration);
  /// Returns a cluster that belongs to this rank from now on; none when no rank has one left in
  /// this iteration. The first victim is the successor and not rank 0, so that no rank is the first
  /// victim of all; then the last victim that gave one. Ranks known to be idle, by their own
  /// messages or by those of others, are left out.
  std::optional<ClusterId> request(std::span<const ClusterId> resident);

  std::uint64_t steals() const { return steals_; }
  std::uint64_t requests() const { return requests_; }

 private:
  Communicator& communicator_;
  Machine& machine_;
  ProgressEngine& engine_;
  int iteration_ = 0;
  int victim_ = 1;                           ///< next victim, in ranks after this one
  std::uint64_t steals_ = 0, requests_ = 0;  ///< in this iteration
};

}  // namespace enfilade
