#include "schemes/spmd/next_uses.hpp"

#include <algorithm>

namespace enfilade {

void NextUses::start(std::span<const ClusterId> turns) {
  turns_.assign(turns.begin(), turns.end());
  state_.assign(turns_.size(), Turn::waiting);
  place_.assign(graph_->size(), nowhere);
  for (std::size_t t = 0; t < turns_.size(); ++t) {
    place_[turns_[t].index()] = static_cast<std::uint32_t>(t);
  }
  past_ = 0;
  first_.clear();
}

void NextUses::done(ClusterId receiver) {
  state_[place_[receiver.index()]] = Turn::done;
  ++past_;
}

void NextUses::gave(ClusterId receiver) { state_[place_[receiver.index()]] = Turn::gone; }

void NextUses::list_uses() {
  const std::size_t clusters = graph_->size();
  first_.assign(clusters + 1, 0);
  const auto for_users = [this](auto visit) {
    for (std::uint32_t t = 0; t < turns_.size(); ++t) {
      visit(turns_[t].index(), t);
      for (const std::uint32_t n : graph_->neighbours(turns_[t].index())) visit(n, t);
    }
  };
  for_users([this](std::size_t c, std::uint32_t) { ++first_[c + 1]; });
  for (std::size_t c = 0; c < clusters; ++c) first_[c + 1] += first_[c];
  uses_.resize(first_.back());
  next_.assign(first_.begin(), first_.end() - 1);
  for_users([this](std::size_t c, std::uint32_t t) { uses_[next_[c]++] = t; });
  next_.assign(first_.begin(), first_.end() - 1);
}

std::uint64_t NextUses::turns_until(std::uint32_t turn) const {
  if (state_[turn] == Turn::gone) return never();
  const std::uint64_t at = state_[turn] == Turn::done ? turn + turns_.size() : turn;
  return at - std::min(past_, at);
}

std::uint64_t NextUses::of(ClusterId cluster, bool links) {
  const std::size_t c = cluster.index();
  if (links) return place_[c] == nowhere ? never() : turns_until(place_[c]);
  if (first_.empty()) list_uses();
  std::uint32_t& next = next_[c];
  while (next < first_[c + 1] && state_[uses_[next]] != Turn::waiting) ++next;
  if (next < first_[c + 1]) return turns_until(uses_[next]);
  for (std::uint32_t i = first_[c]; i < first_[c + 1]; ++i) {
    if (state_[uses_[i]] == Turn::done) return turns_until(uses_[i]);
  }
  return never();
}

}  // namespace enfilade
