#include "parallel/task_list.hpp"

#include <algorithm>
#include <limits>

namespace enfilade {
namespace {
constexpr std::uint32_t nowhere = 0xFFFFFFFFu;
}

TaskList::TaskList(std::vector<ClusterId> own, const VisibilityCost& cost,
                   std::unique_ptr<Order> order)
    : cost_(&cost),
      order_(std::move(order)),
      cycle_(order_->arrange(std::move(own), cost), cost),
      turns_(cycle_.order()) {
  number();
  done_ = turns_.size();  // nothing to do before the first start()
}

void TaskList::number() {
  place_.assign(cost_->graph().size(), nowhere);
  for (std::size_t i = 0; i < turns_.size(); ++i) {
    place_[turns_[i].index()] = static_cast<std::uint32_t>(i);
  }
}

void TaskList::insert(ClusterId cluster, std::vector<ClusterId>& order) const {
  std::size_t best = 0;
  auto least = std::numeric_limits<std::int64_t>::max();
  for (std::size_t i = 0; i < order.size(); ++i) {
    const ClusterId from = order[i], to = order[(i + 1) % order.size()];
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
  number();
  done_ = 0;
}

std::optional<ClusterId> TaskList::next() {
  if (waiting() == 0) return std::nullopt;
  const std::size_t chosen = done_ + order_->choose(std::span(turns_).subspan(done_));
  std::swap(turns_[done_], turns_[chosen]);
  std::swap(place_[turns_[done_].index()], place_[turns_[chosen].index()]);
  return turns_[done_++];
}

std::optional<ClusterId> TaskList::give(std::span<const ClusterId> resident) {
  if (waiting() == 0) return std::nullopt;
  ClusterId cheapest;
  auto least = std::numeric_limits<std::uint64_t>::max();
  for (std::size_t i = done_; i < turns_.size(); ++i) {
    const std::uint64_t bytes = cost_->given(resident, turns_[i]);
    if (bytes <= least) {
      least = bytes;
      cheapest = turns_[i];
    }
  }
  cycle_.remove(cheapest, *cost_);
  std::erase(turns_, cheapest);
  number();
  return cheapest;
}

std::uint64_t TaskList::next_use(ClusterId cluster, bool links) const {
  const std::uint64_t round = turns_.size();
  std::uint64_t soonest = 2 * round + 1;  // never, as far as CYCLE tells
  const auto consider = [&](std::uint32_t place) {
    if (place == nowhere) return;
    soonest = std::min(soonest, place >= done_ ? place - done_ : place + round - done_);
  };
  consider(place_[cluster.index()]);
  if (links) return soonest;
  for (const std::uint32_t n : cost_->graph().neighbours(cluster.index())) consider(place_[n]);
  return soonest;
}

}  // namespace enfilade
