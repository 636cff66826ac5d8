#include "schemes/master/master_scheme.hpp"

namespace enfilade {

IterationPlan MasterScheme::run(RadiosityWork& work, const IterationPlan& plan,
                                const std::vector<double>& changes,
                                std::vector<IterationSummary>& history, const PlanNext& plan_next,
                                const IterationObserver& observer) {
  if (!communicator_.root())
    return run_slave(work, remote_, communicator_, machine_, coarse_correction_, plan, changes);
  ConvergenceMonitor monitor(work, machine_, coarse_correction_, history, plan_next, observer);
  const std::unique_ptr<Dealer> dealer = make_dealer_();
  return Master(work, store_, *dealer, communicator_, machine_, monitor, coarse_correction_)
      .run(plan, changes);
}

}  // namespace enfilade
