// What the SPMD loop asks of the work that it shares out: gathers for clusters, and their files.
#pragma once

#include <functional>
#include <vector>

#include "base/ids.hpp"
#include "machine/machine.hpp"
#include "solver/iteration_plan.hpp"

namespace enfilade {

/// What the coarse system adds to the light of every cluster before the next iteration.
struct Correction {
  std::vector<double> changes;  ///< as the ClusterWork understands them; empty = none
  bool failed = false;          ///< the system could not be solved: there are no changes
  double missing_power =
      0.0;  ///< how much that is: an estimate of what the iterations still lacked
  /// Per band: what it adds to IterationFigures::absorbed_power and escaping_power.
  Spectrum absorbed_power, escaping_power;
};

class ClusterWork {
 public:
  virtual ~ClusterWork() = default;
  /// Iteration plan.iteration - 1 is committed; its light is corrected by `changes`, and the
  /// iteration of the plan begins.
  virtual void begin(const IterationPlan& plan, std::span<const double> changes) = 0;
  /// GathersParallel(C) and WriteOnLocalDirectory(C) of figure 2. Returns the cluster's part of the
  /// sums.
  virtual IterationFigures gather(ClusterId receiver) = 0;
  /// Brings all that these receivers see into memory at once, and keeps it until the next call. Not
  /// needed before a gather; a rank whose clusters come by messages is better off with it.
  virtual void hold(std::span<const ClusterId>) {}
  /// The clusters in this rank's memory, which a thief tells its victim.
  virtual std::vector<ClusterId> resident() const = 0;
  /// MoveToCommonDirectory(S) of figure 2.
  virtual void move_to_common() = 0;
  /// This rank's part of the coarse system of the iteration, the sum of two parts, and the whole
  /// one solved.
  virtual std::vector<double> coarse() const { return {}; }
  virtual std::vector<double> merge(std::span<const double> a, std::span<const double>) const {
    return {a.begin(), a.end()};
  }
  virtual Correction correct(std::span<const double>) const { return {}; }
  /// On rank 0, once every rank has moved: makes the last of `history` the committed iteration.
  virtual void commit(const std::vector<IterationSummary>& history, std::span<const double> changes,
                      bool finished) = 0;

  /// What a rank does now and then in the midst of a gather: answer those that wait for it. One
  /// large gather on a slow host would else hold up all that have run out of work.
  void set_listener(std::function<void()> listener) { listener_ = std::move(listener); }

 protected:
  void listen() const {
    if (listener_) listener_();
  }
  /// Passes the time that a gather's work takes, and listens in between.
  void spend(Machine& machine, const WorkCount& work) const;

 private:
  std::function<void()> listener_;
};

}  // namespace enfilade
