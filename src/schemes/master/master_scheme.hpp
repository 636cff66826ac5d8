// A scheme with a master as a ParallelScheme: rank 0 has the files and deals out the work, and all
// other ranks gather (§2.1, §2.2).
#pragma once

#include <functional>
#include <memory>

#include "schemes/master/dealing.hpp"
#include "schemes/protocol/parallel_scheme.hpp"

namespace enfilade {

class MasterScheme final : public ParallelScheme {
 public:
  /// `make_dealer` makes the dealer, on the master, once the iterations begin. `store`,
  /// `communicator` and `machine` must outlive the scheme.
  MasterScheme(ClusterStore& store, std::function<std::unique_ptr<Dealer>()> make_dealer,
               Communicator& communicator, Machine& machine, bool coarse_correction)
      : store_(store),
        remote_(communicator, machine),
        make_dealer_(std::move(make_dealer)),
        communicator_(communicator),
        machine_(machine),
        coarse_correction_(coarse_correction) {}

  ClusterFiles& files() override {
    return communicator_.root() ? static_cast<ClusterFiles&>(store_) : remote_;
  }
  bool gathers_for_its_own() const override { return false; }
  IterationPlan run(RadiosityWork& work, const IterationPlan& plan,
                    const std::vector<double>& changes, std::vector<IterationSummary>& history,
                    const PlanNext& plan_next, const IterationObserver& observer) override;

 private:
  ClusterStore& store_;
  RemoteFiles remote_;
  std::function<std::unique_ptr<Dealer>()> make_dealer_;
  Communicator& communicator_;
  Machine& machine_;
  bool coarse_correction_;
};

}  // namespace enfilade
