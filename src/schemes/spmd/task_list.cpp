#include "schemes/spmd/task_list.hpp"

#include <algorithm>
#include <limits>

namespace enfilade {

TaskList::TaskList(std::vector<ClusterId> own, const VisibilityCost& cost,
                   std::unique_ptr<Order> order)
    : cost_(&cost),
      order_(std::move(order)),
      cycle_(order_->arrange(std::move(own), cost), cost),
      turns_(cycle_.order()),
      done_(turns_.size()),  // nothing waits before the first start()
      uses_(cost.graph()) {
  uses_.start(turns_);
}

void TaskList::insert(ClusterId cluster, std::vector<ClusterId>& order) const {
  const ClusterGraph& graph = cost_->graph();
  const auto beside = [&](ClusterId other) {
    return graph.has_edge(cluster.index(), other.index());
  };
  // Beside a cluster that it sees, if there is one: with others it shares few visible clusters.
  const bool anywhere = std::none_of(order.begin(), order.end(), beside);
  std::size_t best = 0;
  auto least = std::numeric_limits<std::int64_t>::max();
  for (std::size_t i = 0; i < order.size(); ++i) {
    const ClusterId from = order[i], to = order[(i + 1) % order.size()];
    if (!anywhere && !beside(from) && !beside(to)) continue;
    const auto more = static_cast<std::int64_t>(cost_->between(from, cluster)) +
                      static_cast<std::int64_t>(cost_->between(cluster, to)) -
                      static_cast<std::int64_t>(cost_->between(from, to));
    if (more < least) {
      least = more;
      best = i + 1;
    }
  }
  order.insert(order.begin() + static_cast<std::ptrdiff_t>(best), cluster);
}

void TaskList::start() {
  if (!adopted_.empty()) {
    std::vector<ClusterId> order = cycle_.order();
    for (const ClusterId cluster : adopted_) insert(cluster, order);
    adopted_.clear();
    cycle_ = Cycle(std::move(order), *cost_);
  }
  turns_ = cycle_.order();
  uses_.start(turns_);
  done_ = 0;
}

std::optional<ClusterId> TaskList::next() {
  if (waiting() == 0) return std::nullopt;
  const std::size_t chosen = done_ + order_->choose(std::span(turns_).subspan(done_));
  std::swap(turns_[done_], turns_[chosen]);
  uses_.done(turns_[done_]);
  return turns_[done_++];
}

std::optional<ClusterId> TaskList::give(std::span<const ClusterId> resident) {
  if (waiting() == 0) return std::nullopt;
  const std::vector<std::uint64_t> bytes = cost_->given(resident, std::span(turns_).subspan(done_));
  std::size_t least = 0;
  for (std::size_t i = 1; i < bytes.size(); ++i) {
    if (bytes[i] <= bytes[least]) least = i;
  }
  const ClusterId cheapest = turns_[done_ + least];
  cycle_.remove(cheapest, *cost_);
  turns_.erase(turns_.begin() + static_cast<std::ptrdiff_t>(done_ + least));
  uses_.gave(cheapest);
  return cheapest;
}

}  // namespace enfilade
