// What a master deals out in an iteration, and to whom.
#pragma once

#include <cstdint>
#include <optional>

#include "base/ids.hpp"
#include "schemes/protocol/messages.hpp"

namespace enfilade {

class Dealer {
 public:
  virtual ~Dealer() = default;
  /// A new iteration: every cluster waits for its turn.
  virtual void start() = 0;
  /// What a slave is to do that has nothing to do: an order without clusters where this iteration
  /// has nothing more for it, none where it must wait until others are done. Every slave asks until
  /// it gets an order without clusters.
  virtual std::optional<WorkOrder> next(Rank slave) = 0;
  /// A slave has carried out this part of its order.
  virtual void done(Rank slave, const GatherNote& note) = 0;
  /// Clusters of this iteration that a slave got which were planned for another.
  virtual std::uint64_t moved() const = 0;
};

}  // namespace enfilade
