// Greedy graph growing with a heap of the free nodes at the group's border.
#include "assignment/greedy_groups.hpp"

#include <queue>
#include <utility>

namespace enfilade {

namespace {

constexpr Rank nobody{-1};

/// Grows one group after the other.
class Growing {
 public:
  Growing(const ClusterGraph& graph, const FormFactorEstimate& weights)
      : graph_(graph),
        weights_(weights),
        owner_(graph.size(), nobody),
        to_free_(graph.size(), 0.0),
        to_group_(graph.size(), 0.0) {
    for (std::size_t v = 0; v < graph.size(); ++v) {
      for (std::uint32_t to : graph.neighbours(v)) to_free_[v] += weights.between(v, to);
    }
  }

  void grow(Rank group, std::size_t clusters) {
    to_group_.assign(graph_.size(), 0.0);
    border_ = {};
    for (std::size_t placed = 0; placed < clusters; ++placed) {
      drop_outdated_entries();
      place(border_.empty() ? start() : border_.top().second, group);
    }
  }

  std::vector<Rank> take() { return std::move(owner_); }

 private:
  struct Weaker {
    bool operator()(const std::pair<double, std::uint32_t>& a,
                    const std::pair<double, std::uint32_t>& b) const {
      return a.first != b.first ? a.first < b.first : a.second > b.second;
    }
  };

  bool is_free(std::size_t node) const { return owner_[node] == nobody; }

  std::uint32_t start() const {
    std::size_t best = graph_.size();
    for (std::size_t v = 0; v < graph_.size(); ++v) {
      if (is_free(v) && (best == graph_.size() || to_free_[v] > to_free_[best])) best = v;
    }
    return static_cast<std::uint32_t>(best);
  }

  void place(std::uint32_t node, Rank group) {
    owner_[node] = group;
    for (std::uint32_t to : graph_.neighbours(node)) {
      if (!is_free(to)) continue;
      const double weight = weights_.between(node, to);
      to_free_[to] -= weight;
      to_group_[to] += weight;
      border_.emplace(to_group_[to], to);
    }
  }

  /// A node is pushed on the border again each time it gains weight; only its last entry is valid.
  void drop_outdated_entries() {
    while (!border_.empty() && (!is_free(border_.top().second) ||
                                border_.top().first != to_group_[border_.top().second])) {
      border_.pop();
    }
  }

  const ClusterGraph& graph_;
  const FormFactorEstimate& weights_;
  std::vector<Rank> owner_;
  std::vector<double> to_free_;   ///< weight to clusters of no group yet
  std::vector<double> to_group_;  ///< weight to the members of the group that grows
  std::priority_queue<std::pair<double, std::uint32_t>,
                      std::vector<std::pair<double, std::uint32_t>>, Weaker>
      border_;  ///< free nodes with their weight to the group
};

}  // namespace

std::vector<Rank> greedy_groups(const ClusterGraph& graph, const FormFactorEstimate& weights,
                                int parts) {
  Growing growing(graph, weights);
  std::size_t left = graph.size();
  for (int group = 0; group < parts; ++group) {
    const std::size_t groups_left = static_cast<std::size_t>(parts - group);
    const std::size_t share = (left + groups_left - 1) / groups_left;
    growing.grow(Rank{group}, share);
    left -= share;
  }
  return growing.take();
}

}  // namespace enfilade
