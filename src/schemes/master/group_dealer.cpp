#include "schemes/master/group_dealer.hpp"

#include <algorithm>

#include "assignment/assignment.hpp"

namespace enfilade {
namespace {
constexpr int groups_a_slave =
    4;  // more balance the load better, fewer reuse a slave's memory better
constexpr Rank nobody{0};
}  // namespace

GroupDealer::GroupDealer(const Prepared& prepared, int slaves, const Order& order,
                         const VisibilityCost& cost, bool steal)
    : work_(prepared), slaves_(slaves), steal_(steal) {
  const int clusters = static_cast<int>(prepared.clusters.size());
  const int parts = std::max(1, std::min(clusters, groups_a_slave * slaves));
  const std::vector<Rank> group_of =
      assign(prepared.graph, FormFactorEstimate(prepared.clusters),
             {.method = AssignmentMethod::greedy, .parts = parts, .seed = 1});
  groups_.resize(static_cast<std::size_t>(parts));
  for (std::size_t c = 0; c < group_of.size(); ++c) {
    groups_[static_cast<std::size_t>(group_of[c].value)].clusters.emplace_back(c);
  }
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    groups_[g].clusters = order.arrange(std::move(groups_[g].clusters), cost);
    if (!steal) groups_[g].slave = Rank{1 + static_cast<int>(g) % slaves};
  }
}

void GroupDealer::start() {
  moved_ = 0;
  for (Group& group : groups_) group.waiting = !group.clusters.empty();
}

double GroupDealer::work_of(const Group& group) const {
  double links = 0.0;
  for (const ClusterId c : group.clusters) links += work_.of(c);
  return links;
}

GroupDealer::Group* GroupDealer::waiting_of(Rank slave, bool heaviest) {
  Group* best = nullptr;
  for (Group& group : groups_) {  // of equals the first
    if (!group.waiting || group.slave != slave) continue;
    if (best == nullptr ||
        (heaviest ? work_of(group) > work_of(*best) : work_of(group) < work_of(*best))) {
      best = &group;
    }
  }
  return best;
}

GroupDealer::Group* GroupDealer::choose(Rank slave) {
  if (Group* own = waiting_of(slave, true)) return own;
  if (!steal_) return nullptr;
  if (Group* fresh = waiting_of(nobody, true)) return fresh;
  Rank victim = nobody;
  double most = 0.0;
  for (int s = 1; s <= slaves_; ++s) {
    double waiting = 0.0;
    for (const Group& group : groups_) {
      if (group.waiting && group.slave.value == s) waiting += work_of(group);
    }
    if (waiting > most) {
      most = waiting;
      victim = Rank{s};
    }
  }
  if (victim == nobody) return nullptr;
  Group* taken = waiting_of(victim, false);
  moved_ += taken->clusters.size();
  return taken;
}

std::optional<WorkOrder> GroupDealer::next(Rank slave) {
  Group* group = choose(slave);
  if (group == nullptr) return WorkOrder{};
  group->waiting = false;
  group->slave = slave;
  return WorkOrder{group->clusters, true, {}, {}};
}

void GroupDealer::done(Rank, const GatherNote& note) { work_.learn(note); }

}  // namespace enfilade
