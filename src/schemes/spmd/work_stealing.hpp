// RequestForCluster of figure 4: a rank that has run out of work asks the others, one by one.
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
  /// A cluster that is this rank's from now on; none when nobody has one left in this iteration.
  /// Starts with the successor and not with rank 0, so that the first rank is not everybody's first
  /// victim; goes on with the last victim that gave; and asks nobody of whom it has heard that they
  /// have nothing left, from them or from others.
  std::optional<ClusterId> request(std::span<const ClusterId> resident);

  std::uint64_t steals() const { return steals_; }
  std::uint64_t requests() const { return requests_; }

 private:
  Communicator& communicator_;
  Machine& machine_;
  ProgressEngine& engine_;
  int iteration_ = 0;
  int victim_ = 1;                           ///< the next one to ask: so many ranks after this one
  std::uint64_t steals_ = 0, requests_ = 0;  ///< in this iteration
};

}  // namespace enfilade
