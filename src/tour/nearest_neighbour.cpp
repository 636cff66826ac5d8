// Candidates from a small pool for each cluster; the nearest-neighbour tour through them.
#include "tour/nearest_neighbour.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace enfilade {

namespace {

/// Clusters that are priced for each one's candidates: clusters that it sees, and the rest of its
/// room (close ids).
constexpr std::size_t pool_size = 96;
/// Unvisited clusters on each side by id that are tried where no candidate is left.
constexpr int far_tries = 16;

/// `clusters` sorted by id, and back.
struct ById {
  std::vector<std::uint32_t> place;  ///< sorted position -> place in clusters
  std::vector<std::uint32_t> rank;   ///< place in clusters -> sorted position

  explicit ById(const std::vector<ClusterId>& clusters)
      : place(clusters.size()), rank(clusters.size()) {
    std::iota(place.begin(), place.end(), 0u);
    std::sort(place.begin(), place.end(),
              [&](auto a, auto b) { return clusters[a].value < clusters[b].value; });
    for (std::uint32_t i = 0; i < place.size(); ++i) rank[place[i]] = i;
  }
};

/// Places to price from c: at most pool_size / 2 of the clusters that c sees, evenly spaced, and as
/// many with the closest ids.
std::vector<std::uint32_t> pool_of(std::uint32_t c, const std::vector<ClusterId>& clusters,
                                   const ClusterGraph& graph, const ById& by_id,
                                   const std::vector<std::uint32_t>& place_of) {
  constexpr std::uint32_t elsewhere = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> seen, pool;
  for (std::uint32_t id : graph.neighbours(clusters[c].index())) {
    if (place_of[id] != elsewhere) seen.push_back(place_of[id]);
  }
  const std::size_t take = std::min(seen.size(), pool_size / 2);
  for (std::size_t i = 0; i < take; ++i) pool.push_back(seen[i * seen.size() / take]);
  const std::size_t n = clusters.size(), at = by_id.rank[c];
  const std::size_t reach = pool_size / 4;
  for (std::size_t i = at > reach ? at - reach : 0; i < std::min(n, at + reach + 1); ++i) {
    pool.push_back(by_id.place[i]);
  }
  std::sort(pool.begin(), pool.end());
  pool.erase(std::unique(pool.begin(), pool.end()), pool.end());
  std::erase(pool, c);
  return pool;
}

/// Unvisited places in order of ids, as a doubly linked list.
class Unvisited {
 public:
  explicit Unvisited(std::size_t n) : next_(n + 2), previous_(n + 2) {
    for (std::uint32_t i = 0; i < n + 2; ++i) next_[i] = i + 1, previous_[i] = i - 1;
  }
  void remove(std::uint32_t i) {
    next_[previous_[i + 1]] = next_[i + 1];
    previous_[next_[i + 1]] = previous_[i + 1];
  }
  /// Unvisited before and after the removed i, at most `count` a side.
  std::vector<std::uint32_t> around(std::uint32_t i, int count) const {
    std::vector<std::uint32_t> found;
    const std::uint32_t end = static_cast<std::uint32_t>(next_.size() - 1);
    std::uint32_t low = i + 1, high = i + 1;
    for (int k = 0; k < count; ++k) {
      if (low != 0) low = previous_[low];
      if (high != end) high = next_[high];
      if (low != 0) found.push_back(low - 1);
      if (high != end) found.push_back(high - 1);
    }
    return found;
  }

 private:
  // A node just removed still points to its living neighbours; `around` starts from there.
  std::vector<std::uint32_t> next_, previous_;
};

}  // namespace

CandidateLists candidate_lists(const std::vector<ClusterId>& clusters, const VisibilityCost& cost,
                               std::size_t width) {
  const std::size_t n = clusters.size();
  const ById by_id(clusters);
  std::vector<std::uint32_t> place_of(cost.graph().size(),
                                      std::numeric_limits<std::uint32_t>::max());
  for (std::uint32_t c = 0; c < n; ++c) place_of[clusters[c].index()] = c;
  using Priced = std::pair<std::uint64_t, std::uint32_t>;
  const auto cheapest = [width](std::vector<Priced>& all) {
    const std::size_t take = std::min(width, all.size());
    std::partial_sort(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(take), all.end());
    std::vector<std::uint32_t> places;
    for (std::size_t i = 0; i < take; ++i) places.push_back(all[i].second);
    return places;
  };
  CandidateLists lists;
  lists.width = width;
  for (std::uint32_t c = 0; c < n; ++c) {
    std::vector<Priced> out, in;
    for (std::uint32_t d : pool_of(c, clusters, cost.graph(), by_id, place_of)) {
      out.emplace_back(cost.between(clusters[c], clusters[d]), d);
      in.emplace_back(cost.between(clusters[d], clusters[c]), d);
    }
    lists.after.push_back(cheapest(out));
    lists.before.push_back(cheapest(in));
  }
  return lists;
}

std::vector<std::uint32_t> nearest_neighbour_tour(const std::vector<ClusterId>& clusters,
                                                  const VisibilityCost& cost,
                                                  const CandidateLists& candidates,
                                                  std::uint32_t start) {
  const ById by_id(clusters);
  Unvisited unvisited(clusters.size());
  std::vector<bool> visited(clusters.size(), false);
  std::vector<std::uint32_t> tour{start};
  while (true) {
    const std::uint32_t at = tour.back();
    visited[at] = true;
    unvisited.remove(by_id.rank[at]);
    if (tour.size() == clusters.size()) return tour;
    const auto& near = candidates.after[at];
    const auto free = std::find_if(near.begin(), near.end(), [&](auto d) { return !visited[d]; });
    if (free != near.end()) {
      tour.push_back(*free);
      continue;
    }
    std::pair<std::uint64_t, std::uint32_t> best{~std::uint64_t{0}, 0};
    for (std::uint32_t i : unvisited.around(by_id.rank[at], far_tries)) {
      const std::uint32_t d = by_id.place[i];
      if (!visited[d]) best = std::min(best, {cost.between(clusters[at], clusters[d]), d});
    }
    tour.push_back(best.second);
  }
}

}  // namespace enfilade
