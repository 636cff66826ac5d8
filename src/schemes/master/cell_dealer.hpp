// The replicated CV-sets of [8] (C.-C. Feng and S.-N. Yang, PRS 97), as RR-3425 §2.2 describes
// them.
#pragma once

#include <deque>
#include <vector>

#include "schemes/master/dealer.hpp"
#include "schemes/master/work_estimate.hpp"
#include "tour/unshot_energy.hpp"

namespace enfilade {

/// The cells take turns, and all slaves work on one cell at a time: its CV-set, that is its
/// clusters and all that they see, is copied to every slave that works on it, and its clusters are
/// dealt by estimated workload. In the first iteration the cells come in the order of a travelling
/// salesman, in later ones by unshot energy; a slave that is out of work steals.
///
/// Differences from §2.2, and decisions that it leaves open:
/// - [8] shoots the energy of a cell's patches; here a cell's clusters gather, with the kernels of
///   all schemes, and the smallest task is one cluster.
/// - The travelling salesman's costs are those of OVG between cells: the bytes of the clusters that
///   are visible from one cell and not from the other.
/// - A cell's unshot energy is the unshot energy visible to its clusters (tour/unshot_energy.hpp).
/// - The master keeps the tasks that have not begun, so that a slave steals by a request to the
///   master, which refuses under --no-steal.
/// - The next cell begins when this one is done, with the newest light.
class CellDealer final : public Dealer {
 public:
  /// emitted_power[c]: of cluster c. `prepared` must outlive it.
  CellDealer(const Prepared& prepared, int slaves, const std::vector<double>& emitted_power,
             std::uint64_t seed, bool steal);
  void start() override;
  std::optional<WorkOrder> next(Rank slave) override;
  void done(Rank slave, const GatherNote& note) override;
  std::uint64_t moved() const override { return moved_; }

 private:
  using Clusters = std::vector<ClusterId>;
  struct Slave {
    std::deque<ClusterId> tasks;  ///< of the current cell
    std::size_t notified = 0;     ///< number of gathered_ that its orders have listed
    bool holds_cell = false;      ///< has been sent the current cell's CV-set
  };
  /// Deals the next cell; returns false where all have had their turn.
  bool open_cell();
  std::size_t choose_cell() const;
  std::optional<ClusterId> task_for(Slave& slave);

  UnshotEnergy light_;
  WorkEstimate work_;
  bool steal_, first_iteration_ = true;
  std::vector<Clusters> cells_;             ///< in the travelling salesman's order
  std::vector<std::size_t> cells_to_come_;  ///< of this iteration, places in cells_
  std::size_t cell_ = 0;                    ///< the current one
  std::vector<Slave> slaves_;
  std::size_t under_way_ = 0;  ///< clusters that slaves are gathering for
  Clusters gathered_;          ///< in this iteration, in the order of the notes
  std::uint64_t moved_ = 0;
};

}  // namespace enfilade
