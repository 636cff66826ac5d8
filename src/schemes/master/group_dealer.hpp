// The group iteration of [6] (T. Funkhouser, SIGGRAPH 96), as RR-3425 §2.1 tells of it.
#pragma once

#include <vector>

#include "schemes/master/dealer.hpp"
#include "schemes/master/work_estimate.hpp"
#include "tour/order.hpp"

namespace enfilade {

/// The master splits the graph of clusters, weighted by estimated form factors, into groups, and
/// hands them to the slaves; a slave gathers for its group and sends the master what came of it.
/// Which slave has which group varies, and so the load is balanced.
///
/// What §2.1 leaves open is settled here as follows.
/// - Groups: four a slave, grown greedily (assignment/greedy_groups.hpp); --order arranges a group.
/// - Balance: a slave gets the groups that it had in the last iteration, whose clusters may still
/// be
///   in its memory, those of most work first; then one that nobody has had; then the lightest of
///   the slave with most work waiting. --no-steal: a group stays with its first slave.
/// - A slave holds what one receiver sees at a time, which it asks the master for in one message.
/// - Within a group the newest light is gathered, of other groups the last iteration's: §8's
/// iteration.
class GroupDealer final : public Dealer {
 public:
  GroupDealer(const Prepared& prepared, int slaves, const Order& order, const VisibilityCost& cost,
              bool steal);
  void start() override;
  std::optional<WorkOrder> next(Rank slave) override;
  void done(Rank slave, const GatherNote& note) override;
  std::uint64_t moved() const override { return moved_; }

 private:
  struct Group {
    std::vector<ClusterId> clusters;
    Rank slave;  ///< that had it last; none: rank 0, which is the master
    bool waiting = false;
  };
  double work_of(const Group& group) const;
  Group* choose(Rank slave);
  /// The heaviest (or lightest) waiting group of a slave; none where it has none.
  Group* waiting_of(Rank slave, bool heaviest);

  WorkEstimate work_;
  int slaves_;
  bool steal_;
  std::vector<Group> groups_;
  std::uint64_t moved_ = 0;
};

}  // namespace enfilade
