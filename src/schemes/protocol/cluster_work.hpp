// The work that a parallel scheme distributes over the ranks: gathers for clusters, and their
// files. RadiosityWork computes; ReplayWork charges recorded gathers.
#pragma once

#include <functional>
#include <vector>

#include "base/ids.hpp"
#include "machine/machine.hpp"
#include "solver/iteration_end.hpp"

namespace enfilade {

class ClusterWork {
 public:
  virtual ~ClusterWork() = default;
  /// Begins iteration `plan.iteration`. The one before is committed, and its light is corrected by
  /// `changes`.
  virtual void begin(const IterationPlan& plan, std::span<const double> changes) = 0;
  /// GathersParallel(C) and WriteOnLocalDirectory(C) of figure 2. Returns the figures of this
  /// gather.
  virtual IterationFigures gather(ClusterId receiver) = 0;
  /// Brings all that these receivers see into memory at once, and keeps it until the next call.
  /// Never necessary before a gather; saves messages where the clusters come by messages.
  virtual void hold(std::span<const ClusterId>) {}
  /// Returns the clusters in this rank's memory; a thief sends them in its steal request.
  virtual std::vector<ClusterId> resident() const = 0;
  /// MoveToCommonDirectory(S) of figure 2.
  virtual void move_to_common() = 0;
  /// Returns what the far field needs of the clusters that this rank has gathered for in this
  /// iteration, as numbers; those of several ranks are put one after the other.
  virtual std::vector<double> far_light() const { return {}; }
  /// Takes these numbers of all ranks; the next begin() uses them.
  virtual void take_far_light(std::span<const double>) {}
  /// Returns this rank's part of the iteration's coarse system, as numbers.
  virtual std::vector<double> coarse() const { return {}; }
  /// Returns the sum of two parts of the coarse system.
  virtual std::vector<double> merge(std::span<const double> a, std::span<const double>) const {
    return {a.begin(), a.end()};
  }
  /// Solves the whole coarse system.
  virtual Correction correct(std::span<const double>) const { return {}; }
  /// On rank 0, once every rank has moved its files: makes the last of `history` the committed
  /// iteration.
  virtual void commit(const std::vector<IterationSummary>& history, std::span<const double> changes,
                      bool finished) = 0;

  /// Sets the function that answers the messages of other ranks. It is called during a gather as
  /// well, since one large gather on a slow host would otherwise delay every rank that has run out
  /// of work.
  void set_listener(std::function<void()> listener) { listener_ = std::move(listener); }

 protected:
  void listen() const {
    if (listener_) listener_();
  }
  /// Charges a gather's work to the machine; polls in between.
  void spend(Machine& machine, const WorkCount& work) const {
    if (listener_) {
      machine.compute_in_parts(work, listener_);
    } else {
      machine.compute(work);
    }
  }

 private:
  std::function<void()> listener_;
};

}  // namespace enfilade
