// Bit-parallel breadth-first searches.
#include "assignment/hop_distance.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "assignment/assignment.hpp"
#include "base/error.hpp"

namespace enfilade {

namespace {

constexpr std::size_t batch_words = 4;
constexpr std::size_t batch_size = 64 * batch_words;
using Bits = std::array<std::uint64_t, batch_words>;

int count(const Bits& a) {
  int bits = 0;
  for (std::uint64_t word : a) bits += std::popcount(word);
  return bits;
}

bool empty(const Bits& a) { return (a[0] | a[1] | a[2] | a[3]) == 0; }

/// Up to 256 breadth-first searches in lockstep: bit s of a node's word says that search s has
/// reached it, so that an edge is followed once a level for all of them. The searches of a group
/// end once they have reached all its members.
class BatchSearch {
 public:
  BatchSearch(const ClusterGraph& graph, std::span<const std::uint32_t> group,
              std::span<const std::uint32_t> pivots, std::size_t groups)
      : graph_(graph),
        group_(group),
        own_(groups, Bits{}),
        wanted_(groups, 0),
        seen_(graph.size(), Bits{}),
        frontier_(graph.size(), Bits{}),
        next_(graph.size(), Bits{}) {
    for (std::size_t s = 0; s < pivots.size(); ++s) {
      const std::uint64_t bit = std::uint64_t{1} << (s % 64);
      own_[group[pivots[s]]][s / 64] |= bit;
      seen_[pivots[s]][s / 64] |= bit;
      frontier_[pivots[s]][s / 64] |= bit;
      active_.push_back(pivots[s]);
    }
    for (std::size_t g = 0; g < groups; ++g) wanted_[g] = count(own_[g]);
  }

  void run(Centrality& result) {
    const std::size_t n = graph_.size();
    std::vector<int> missing(n);
    std::vector<std::uint64_t> left(own_.size(), 0);
    for (std::size_t v = 0; v < n; ++v) {
      missing[v] = wanted_[group_[v]] - count_own(seen_[v], group_[v]);
      left[group_[v]] += static_cast<std::uint64_t>(missing[v]);
    }
    for (std::uint32_t level = 1; keep_needed(left) && spread(); ++level) {
      for (std::uint32_t v : active_) {
        const int found = arrive(v);
        if (found == 0) continue;
        result.sum[v] += static_cast<std::uint64_t>(found) * level;
        result.max[v] = std::max(result.max[v], level);
        missing[v] -= found;
        left[group_[v]] -= static_cast<std::uint64_t>(found);
      }
    }
    for (std::size_t v = 0; v < n; ++v) {
      if (missing[v] == 0) continue;
      result.sum[v] += static_cast<std::uint64_t>(missing[v]) * n;
      result.max[v] = static_cast<std::uint32_t>(n);
    }
  }

 private:
  int count_own(const Bits& a, std::size_t group) const {
    Bits own = own_[group];
    for (std::size_t w = 0; w < batch_words; ++w) own[w] &= a[w];
    return count(own);
  }

  /// Keeps the searches of groups with members still to be reached; false where there are none.
  bool keep_needed(const std::vector<std::uint64_t>& left) {
    going_on_ = Bits{};
    for (std::size_t g = 0; g < own_.size(); ++g) {
      if (left[g] == 0) continue;
      for (std::size_t w = 0; w < batch_words; ++w) going_on_[w] |= own_[g][w];
    }
    return !empty(going_on_);
  }

  /// Carries the frontier over every edge to the nodes that are active next; false where there are
  /// none.
  bool spread() {
    reached_.clear();
    for (std::uint32_t v : active_) {
      Bits from = std::exchange(frontier_[v], Bits{});
      for (std::size_t w = 0; w < batch_words; ++w) from[w] &= going_on_[w];
      if (empty(from)) continue;
      for (std::uint32_t to : graph_.neighbours(v)) {
        if (empty(next_[to])) reached_.push_back(to);
        for (std::size_t w = 0; w < batch_words; ++w) next_[to][w] |= from[w];
      }
    }
    active_.swap(reached_);
    return !active_.empty();
  }

  /// Makes the searches that reached v its new frontier; returns how many of them are of its group.
  int arrive(std::size_t v) {
    for (std::size_t w = 0; w < batch_words; ++w) {
      frontier_[v][w] = next_[v][w] & ~seen_[v][w];
      seen_[v][w] |= next_[v][w];
      next_[v][w] = 0;
    }
    return count_own(frontier_[v], group_[v]);
  }

  const ClusterGraph& graph_;
  std::span<const std::uint32_t> group_;
  std::vector<Bits> own_;    ///< searches that start in the group
  std::vector<int> wanted_;  ///< how many these are
  Bits going_on_{};
  std::vector<Bits> seen_, frontier_, next_;
  std::vector<std::uint32_t> active_, reached_;
};

}  // namespace

std::vector<std::uint32_t> hop_distances(const ClusterGraph& graph, std::size_t source) {
  ENFILADE_CHECK(source < graph.size(), std::to_string(source));
  constexpr std::uint32_t unreachable = 0xFFFFFFFFu;
  std::vector<std::uint32_t> hops(graph.size(), unreachable);
  std::vector<std::uint32_t> queue{static_cast<std::uint32_t>(source)};
  hops[source] = 0;
  for (std::size_t head = 0; head < queue.size(); ++head) {
    const std::uint32_t v = queue[head];
    for (std::uint32_t to : graph.neighbours(v)) {
      if (hops[to] != unreachable) continue;
      hops[to] = hops[v] + 1;
      queue.push_back(to);
    }
  }
  return hops;
}

NearestSources nearest_sources(const ClusterGraph& graph, std::span<const std::uint32_t> sources) {
  constexpr std::uint32_t unreachable = 0xFFFFFFFFu;
  NearestSources nearest;
  nearest.words = (sources.size() + 63) / 64;
  nearest.masks.assign(graph.size() * nearest.words, 0);
  std::vector<std::uint32_t> hops(graph.size(), unreachable);
  std::vector<std::uint32_t> queue;
  for (std::size_t s = 0; s < sources.size(); ++s) {
    nearest.masks[sources[s] * nearest.words + s / 64] |= std::uint64_t{1} << (s % 64);
    if (hops[sources[s]] != unreachable) continue;
    hops[sources[s]] = 0;
    queue.push_back(sources[s]);
  }
  // A node's nearest sources are those of its neighbours that are one hop nearer; the queue is in
  // order of hops, so a node's own set is complete before it is passed on.
  for (std::size_t head = 0; head < queue.size(); ++head) {
    const std::uint32_t v = queue[head];
    for (std::uint32_t to : graph.neighbours(v)) {
      if (hops[to] == unreachable) {
        hops[to] = hops[v] + 1;
        queue.push_back(to);
      }
      if (hops[to] != hops[v] + 1) continue;
      for (std::size_t w = 0; w < nearest.words; ++w) {
        nearest.masks[to * nearest.words + w] |= nearest.masks[v * nearest.words + w];
      }
    }
  }
  return nearest;
}

Centrality centrality(const ClusterGraph& graph, std::span<const std::uint32_t> group,
                      std::span<const std::uint32_t> pivots) {
  Centrality result;
  result.sum.assign(graph.size(), 0);
  result.max.assign(graph.size(), 0);
  if (graph.size() == 0) return result;
  const std::size_t groups = *std::max_element(group.begin(), group.end()) + std::size_t{1};
  for (std::size_t first = 0; first < pivots.size(); first += batch_size) {
    const std::size_t last = std::min(first + batch_size, pivots.size());
    BatchSearch(graph, group, pivots.subspan(first, last - first), groups).run(result);
  }
  return result;
}

}  // namespace enfilade
