// A parallel scheme: how the ranks share the work of the iterations, and how a rank reads and
// writes the clusters' files. schemes/solve/make_scheme.hpp chooses one.
#pragma once

#include <vector>

#include "schemes/protocol/convergence_monitor.hpp"
#include "schemes/protocol/radiosity_work.hpp"

namespace enfilade {

/// One rank's object of a scheme, made on every rank.
class ParallelScheme {
 public:
  virtual ~ParallelScheme() = default;
  /// Returns the files through which this rank reads and writes clusters; its RadiosityWork uses
  /// them.
  virtual ClusterFiles& files() = 0;
  /// True where this rank gathers for the clusters that it is assigned (until some are stolen), so
  /// that it keeps them in memory when it makes them before the first iteration.
  virtual bool gathers_for_its_own() const = 0;
  /// Runs iterations from `plan` on until one is the last; all ranks call it. `changes` corrects
  /// the light of the committed iteration (a resumed run; else empty). `history` holds the
  /// iterations before on rank 0, and grows there; `plan_next` and `observer` are called there.
  /// Returns the plan that ended the run, on every rank.
  virtual IterationPlan run(RadiosityWork& work, const IterationPlan& plan,
                            const std::vector<double>& changes,
                            std::vector<IterationSummary>& history, const PlanNext& plan_next,
                            const IterationObserver& observer) = 0;
};

}  // namespace enfilade
