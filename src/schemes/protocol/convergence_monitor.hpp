// The end of an iteration, on rank 0: what all ranks did is summed up, committed, and followed by a
// plan.
#pragma once

#include <functional>
#include <vector>

#include "machine/machine.hpp"
#include "schemes/protocol/cluster_work.hpp"
#include "schemes/protocol/messages.hpp"

namespace enfilade {

/// With the sums of all ranks of an iteration as the last of `history`: sets its error, and says
/// what follows.
using PlanNext = std::function<IterationPlan(std::vector<IterationSummary>& history)>;

class ConvergenceMonitor {
 public:
  /// All must outlive it. `history` holds what came before, and grows here.
  ConvergenceMonitor(ClusterWork& work, Machine& machine, bool coarse_correction,
                     std::vector<IterationSummary>& history, const PlanNext& plan_next,
                     const IterationObserver& observer);
  /// `token`: everybody's numbers, once every rank is idle and has moved its files.
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

/// A rank's own numbers of an iteration.
Token own_token(const ClusterWork& work, const IterationFigures& figures, bool coarse_correction);
/// Folds another rank's numbers into a token.
void add_token(const ClusterWork& work, Token& token, const Token& own, bool coarse_correction);

}  // namespace enfilade
