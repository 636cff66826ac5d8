// The end of an iteration, on rank 0: the figures of all ranks become a summary, the iteration is
// committed, and the plan of the next one is made.
#pragma once

#include <functional>
#include <vector>

#include "machine/machine.hpp"
#include "schemes/protocol/cluster_work.hpp"
#include "schemes/protocol/messages.hpp"

namespace enfilade {

/// Called with the summary of an iteration as the last of `history`: sets its error, and returns
/// the plan of the next iteration, or one that is finished.
using PlanNext = std::function<IterationPlan(std::vector<IterationSummary>& history)>;

class ConvergenceMonitor {
 public:
  /// All must outlive it. `history` holds the iterations before this run, and grows by decide().
  ConvergenceMonitor(ClusterWork& work, Machine& machine, bool coarse_correction,
                     std::vector<IterationSummary>& history, const PlanNext& plan_next,
                     const IterationObserver& observer);
  /// Ends the iteration of `plan`: solves the coarse system, plans, commits. `token` holds the
  /// numbers of all ranks, each of which is idle and has moved its files.
  Decision decide(const IterationPlan& plan, const Token& token);

 private:
  ClusterWork& work_;
  Machine& machine_;
  bool coarse_correction_;
  std::vector<IterationSummary>& history_;
  const PlanNext& plan_next_;
  const IterationObserver& observer_;
  double start_s_;
};

/// Returns a rank's own numbers of an iteration.
Token own_token(const ClusterWork& work, const IterationFigures& figures, bool coarse_correction);
/// Folds another rank's numbers into a token.
void add_token(const ClusterWork& work, Token& token, const Token& own, bool coarse_correction);

}  // namespace enfilade
