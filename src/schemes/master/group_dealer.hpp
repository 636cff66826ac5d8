// The group iteration of [6] (T. Funkhouser, SIGGRAPH 96), as RR-3425 §2.1 describes it.
#pragma once

#include <vector>

#include "schemes/master/dealer.hpp"
#include "schemes/master/work_estimate.hpp"
#include "tour/order.hpp"

namespace enfilade {

/// The master splits the graph of clusters, weighted by estimated form factors, into groups, and
/// deals them to the slaves; a slave gathers for its group and sends the master the results. The
/// load is balanced by dealing a group to another slave in another iteration.
///
/// Decisions that §2.1 leaves open:
/// - Groups: four for each slave, grown greedily (assignment/greedy_groups.hpp); --order arranges a
///   group.
/// - Balance: a slave gets the groups that it had in the last iteration, whose clusters may still
///   be in its memory, the heaviest first; then one that no slave has had; then the lightest group
///   of the slave with most work waiting. --no-steal: a group stays with its first slave.
/// - A slave holds the clusters that one receiver sees at a time, requested in one message.
/// - Gathers take the newest light of their own group, and of other groups the light of the last
///   iteration: the group iteration of §8.
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
    Rank slave;  ///< the slave that had it last; rank 0, the master: none
    bool waiting = false;
  };
  double work_of(const Group& group) const;
  Group* choose(Rank slave);
  /// Returns the heaviest (or lightest) waiting group of a slave; null where it has none.
  Group* waiting_of(Rank slave, bool heaviest);

  WorkEstimate work_;
  int slaves_;
  bool steal_;
  std::vector<Group> groups_;
  std::uint64_t moved_ = 0;
};

}  // namespace enfilade
