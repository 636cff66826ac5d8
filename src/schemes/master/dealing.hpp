// The loop of the schemes with a master: rank 0 owns the files and deals out the work, all other
// ranks gather, and clusters and results go by messages (§2.1, §2.2).
#pragma once

#include <map>
#include <vector>

#include "schemes/master/dealer.hpp"
#include "schemes/master/remote_files.hpp"
#include "schemes/protocol/convergence_monitor.hpp"
#include "store/cluster_store.hpp"

namespace enfilade {

/// The messages of an iteration. Slave to master: WorkRequest; master to slave: WorkOrder; these
/// repeat. While a slave carries out an order, it sends SectionRequests, which the master answers
/// by SectionReplies, and a ClusterResult for each gather. After an order without clusters, slave
/// to master: Token. When all tokens have come, master to slaves: Decision.
class Master {
 public:
  /// All must outlive it. `work` gathers nothing here: it merges, corrects and commits.
  Master(ClusterWork& work, ClusterStore& store, Dealer& dealer, Communicator& communicator,
         Machine& machine, ConvergenceMonitor& monitor, bool coarse_correction)
      : work_(work),
        store_(store),
        dealer_(dealer),
        communicator_(communicator),
        machine_(machine),
        monitor_(monitor),
        coarse_correction_(coarse_correction) {}
  /// Runs iterations from `plan` on until one is the last; returns the plan that ended the run.
  IterationPlan run(IterationPlan plan, std::vector<double> changes);

 private:
  /// Serves the slaves until each has sent its token; returns the numbers of all ranks.
  Token deal();
  void serve(Rank slave, Message message);
  /// Sends orders to the waiting slaves that the dealer has one for.
  void answer_waiting();

  ClusterWork& work_;
  ClusterStore& store_;
  Dealer& dealer_;
  Communicator& communicator_;
  Machine& machine_;
  ConvergenceMonitor& monitor_;
  bool coarse_correction_;
  std::vector<Rank> waiting_;  ///< slaves without an order, in the order of their requests
  std::map<Rank, Token> tokens_;
};

/// Runs a slave's iterations. Returns the plan that ended the run.
IterationPlan run_slave(ClusterWork& work, RemoteFiles& files, Communicator& communicator,
                        Machine& machine, bool coarse_correction, IterationPlan plan,
                        std::vector<double> changes);

}  // namespace enfilade
