#include "parallel/task_list.hpp"

#include <algorithm>
#include <limits>

namespace enfilade {
namespace {
constexpr std::uint32_t nowhere = 0xFFFFFFFFu;
}

TaskList::TaskList(std::vector<ClusterId> own, const VisibilityCost& cost, TourOrder order,
                   std::uint64_t seed)
    : cost_(&cost), seed_(seed), cycle_(std::move(own), cost, order, seed) {
  number();
  done_ = cycle_.order().size();  // nothing to do before the first start()
}

void TaskList::number() {
  place_.assign(cost_->graph().size(), nowhere);
  for (std::size_t i = 0; i < cycle_.order().size(); ++i) {
    place_[cycle_.order()[i].index()] = static_cast<std::uint32_t>(i);
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
    cycle_ = Cycle(std::move(order), *cost_, TourOrder::input, seed_);
    number();
  }
  done_ = 0;
}

std::optional<ClusterId> TaskList::next() {
  if (waiting() == 0) return std::nullopt;
  return cycle_.order()[done_++];
}

std::optional<ClusterId> TaskList::give(std::span<const ClusterId> resident) {
  if (waiting() == 0) return std::nullopt;
  ClusterId cheapest;
  auto least = std::numeric_limits<std::uint64_t>::max();
  for (std::size_t i = done_; i < cycle_.order().size(); ++i) {
    const std::uint64_t bytes = cost_->given(resident, cycle_.order()[i]);
    if (bytes <= least) {
      least = bytes;
      cheapest = cycle_.order()[i];
    }
  }
  cycle_.remove(cheapest, *cost_);
  number();
  return cheapest;
}

std::uint64_t TaskList::next_use(ClusterId cluster, bool links) const {
  const std::uint64_t round = cycle_.order().size();
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
