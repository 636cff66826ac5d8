// Figure 1's loop: centres of gravity, groups around them, and again.
#include "assignment/kmeans.hpp"

#include <algorithm>
#include <bit>
#include <numeric>
#include <set>
#include <tuple>

#include "assignment/hop_distance.hpp"
#include "base/random.hpp"

namespace enfilade {

namespace {

/// Members that a group's centre is judged from: enough for a centre within a few percent of the
/// best, and a bound on the searches of a round.
constexpr std::size_t pivots_a_group = 32;
/// Sweeps over the nodes that are equally near to several centres.
constexpr int choices_of_a_tie = 3;
/// Imbalance that work stealing makes good: starts below it are compared by their cut edges alone.
constexpr double even_enough = 1.25;

/// `parts` different nodes, random (ChooseCenterOfGravities).
std::vector<std::uint32_t> random_centres(std::size_t nodes, std::size_t parts,
                                          std::uint64_t seed) {
  Random random(seed);
  std::vector<std::uint32_t> all(nodes);
  std::iota(all.begin(), all.end(), 0u);
  for (std::size_t i = 0; i < parts; ++i) std::swap(all[i], all[i + random.below(nodes - i)]);
  all.resize(parts);
  return all;
}

/// Puts every node into the group of its nearest centre.
class Grouping {
 public:
  Grouping(const ClusterGraph& graph, std::size_t parts)
      : graph_(graph), parts_(parts), fair_share_((graph.size() * 11 / 10 + parts - 1) / parts) {}

  std::vector<Rank> around(std::span<const std::uint32_t> centres) {
    const NearestSources nearest = nearest_sources(graph_, centres);
    owner_.assign(graph_.size(), Rank{-1});
    size_.assign(parts_, 0);
    std::vector<std::uint32_t> tied;
    for (std::uint32_t v = 0; v < graph_.size(); ++v) {
      collect(nearest.of(v));
      if (candidates_.size() == 1) {
        put(v, candidates_.front());
      } else {
        tied.push_back(v);
      }
    }
    // In the first sweep few neighbours have a group yet, so that the choice is made again.
    for (int sweep = 0; sweep < choices_of_a_tie; ++sweep) {
      for (std::uint32_t v : tied) {
        if (sweep > 0) --size_[static_cast<std::size_t>(owner_[v].value)];
        collect(nearest.of(v));
        put(v, best_of_candidates(v));
      }
    }
    return owner_;
  }

 private:
  void put(std::uint32_t node, std::size_t group) {
    owner_[node] = Rank{static_cast<int>(group)};
    ++size_[group];
  }

  /// The nearest centres; all of them where none can be reached (a part of the graph without a
  /// centre).
  void collect(std::span<const std::uint64_t> mask) {
    candidates_.clear();
    for (std::size_t w = 0; w < mask.size(); ++w) {
      for (std::uint64_t word = mask[w]; word != 0; word &= word - 1) {
        candidates_.push_back(w * 64 + static_cast<std::size_t>(std::countr_zero(word)));
      }
    }
    if (!candidates_.empty()) return;
    candidates_.resize(parts_);
    std::iota(candidates_.begin(), candidates_.end(), std::size_t{0});
  }

  std::size_t best_of_candidates(std::uint32_t node) {
    neighbours_in_.assign(parts_, 0);
    for (std::uint32_t to : graph_.neighbours(node)) {
      if (owner_[to].value >= 0) ++neighbours_in_[static_cast<std::size_t>(owner_[to].value)];
    }
    const auto rank = [this](std::size_t g) {
      const bool full = size_[g] >= fair_share_;
      return std::tuple(full, full ? 0 : -neighbours_in_[g], size_[g], g);
    };
    return *std::min_element(candidates_.begin(), candidates_.end(),
                             [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
  }

  const ClusterGraph& graph_;
  std::size_t parts_;
  std::size_t
      fair_share_;  ///< a tenth above the mean, so that rooms are not cut for the last nodes
  std::vector<Rank> owner_;
  std::vector<std::size_t> size_, candidates_;
  std::vector<std::int64_t> neighbours_in_;
};

}  // namespace

std::vector<std::uint32_t> centres_of_gravity(const ClusterGraph& graph,
                                              const std::vector<Rank>& owner, std::size_t parts,
                                              std::size_t max_pivots) {
  std::vector<std::uint32_t> group(owner.size());
  std::vector<std::vector<std::uint32_t>> members(parts);
  for (std::uint32_t v = 0; v < owner.size(); ++v) {
    group[v] = static_cast<std::uint32_t>(owner[v].value);
    members[group[v]].push_back(v);
  }
  std::vector<std::uint32_t> pivots;
  for (const auto& list : members) {
    const std::size_t take = std::min(list.size(), max_pivots);
    for (std::size_t i = 0; i < take; ++i) pivots.push_back(list[i * list.size() / take]);
  }
  const Centrality central = centrality(graph, group, pivots);
  std::vector<std::uint32_t> centres(parts, 0);
  for (std::size_t g = 0; g < parts; ++g) {
    const auto key = [&](std::uint32_t v) { return std::tuple(central.sum[v], central.max[v], v); };
    const auto best = std::min_element(members[g].begin(), members[g].end(),
                                       [&](auto a, auto b) { return key(a) < key(b); });
    if (best != members[g].end()) centres[g] = *best;
  }
  return centres;
}

namespace {

/// Figure 1's loop from one choice of first centres.
std::vector<Rank> groups_from(const ClusterGraph& graph, const AssignmentConfig& config,
                              std::uint64_t seed) {
  const std::size_t parts = static_cast<std::size_t>(config.parts);
  std::vector<std::uint32_t> centres = random_centres(graph.size(), parts, seed);
  Grouping grouping(graph, parts);
  std::vector<Rank> owner;
  // The centres alone decide the next groups: centres that occurred before mean a fixed point or a
  // cycle of groupings.
  std::set<std::vector<std::uint32_t>> met;
  for (int k = 0; k < config.max_iterations && met.insert(centres).second; ++k) {
    owner = grouping.around(centres);
    centres = centres_of_gravity(graph, owner, parts, pivots_a_group);
  }
  return owner.empty() ? grouping.around(centres) : owner;
}

}  // namespace

std::vector<Rank> kmeans_groups(const ClusterGraph& graph, const AssignmentConfig& config) {
  std::vector<Rank> best;
  std::pair<double, std::size_t> least;
  Random seeds(config.seed);
  for (int start = 0; start < std::max(config.starts, 1); ++start) {
    std::vector<Rank> owner = groups_from(graph, config, start == 0 ? config.seed : seeds.next());
    const PartitionQuality q = quality(graph, owner, config.parts);
    const std::pair rank(std::max(q.imbalance, even_enough), q.edge_cut);
    if (start > 0 && rank >= least) continue;
    best = std::move(owner);
    least = rank;
  }
  return best;
}

}  // namespace enfilade
