// A dealer decides for the master which clusters each slave gathers for.
#pragma once

#include <cstdint>
#include <optional>

#include "base/ids.hpp"
#include "schemes/protocol/messages.hpp"

namespace enfilade {

class Dealer {
 public:
  virtual ~Dealer() = default;
  /// Begins an iteration: every cluster waits for its turn.
  virtual void start() = 0;
  /// Returns the next order for a slave that is out of work. An order without clusters: this
  /// iteration has no more work for it. No order: it must wait until other slaves are done. Every
  /// slave requests work until it gets an order without clusters.
  virtual std::optional<WorkOrder> next(Rank slave) = 0;
  /// Records a gather of a slave.
  virtual void done(Rank slave, const GatherNote& note) = 0;
  /// Returns the number of clusters of this iteration that were dealt to another slave than
  /// planned.
  virtual std::uint64_t moved() const = 0;
};

}  // namespace enfilade
