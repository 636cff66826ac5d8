#include "visibility/hidden_pairs.hpp"

#include <algorithm>
#include <tuple>

namespace enfilade {
namespace {

using Pair = std::pair<std::uint32_t, std::uint32_t>;
using Group = std::vector<std::uint32_t>;

constexpr std::size_t fewest_together = 3;  // pairs; fewer are tried one by one

class HiddenPairs {
 public:
  HiddenPairs(std::span<const Cluster> clusters, const Occlusion& occlusion)
      : clusters_(clusters), occlusion_(occlusion) {}

  /// Appends those of the pairs that are not hidden.
  void judge(std::span<Pair> pairs, std::vector<Pair>& kept) const {
    const Group a = group(pairs, &Pair::first), b = group(pairs, &Pair::second);
    if (pairs.size() < fewest_together || clusters_[a[0]].cell == clusters_[b[0]].cell) {
      for (const Pair& pair : pairs) {
        if (occlusion_.between(pair.first, pair.second) != Sight::hidden) kept.push_back(pair);
      }
      return;
    }
    if (occlusion_.between_groups(a, b) == Sight::hidden) return;
    const bool cut_a = b.size() == 1 || (a.size() > 1 && box(a).diagonal() >= box(b).diagonal());
    const auto end = cut_a ? halve(pairs, a, &Pair::first) : halve(pairs, b, &Pair::second);
    judge(pairs.first(end), kept);
    judge(pairs.subspan(end), kept);
  }

 private:
  static Group group(std::span<const Pair> pairs, std::uint32_t Pair::*side) {
    Group all;
    for (const Pair& pair : pairs) all.push_back(pair.*side);
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }

  Box box(const Group& group) const {
    Box all;
    for (const std::uint32_t i : group) all.add(clusters_[i].bounds);
    return all;
  }

  /// Pairs whose cluster lies in the group's lower half first; where those end.
  std::size_t halve(std::span<Pair> pairs, Group group, std::uint32_t Pair::*side) const {
    const Vec3 e = box(group).extent();
    const int axis = e.x >= e.y && e.x >= e.z ? 0 : e.y >= e.z ? 1 : 2;
    const auto before = [&](std::uint32_t i, std::uint32_t j) {
      return std::pair(clusters_[i].bounds.center()[axis], i) <
             std::pair(clusters_[j].bounds.center()[axis], j);
    };
    std::sort(group.begin(), group.end(), before);
    const std::uint32_t middle = group[group.size() / 2];
    const auto end = std::stable_partition(
        pairs.begin(), pairs.end(), [&](const Pair& pair) { return before(pair.*side, middle); });
    return static_cast<std::size_t>(end - pairs.begin());
  }

  std::span<const Cluster> clusters_;
  const Occlusion& occlusion_;
};

}  // namespace

void drop_hidden(std::vector<Pair>& pairs, std::span<const Cluster> clusters,
                 const Occlusion& occlusion, const Progress& progress, double done_before) {
  const auto cells = [&](const Pair& pair) {
    return std::pair(clusters[pair.first].cell, clusters[pair.second].cell);
  };
  std::sort(pairs.begin(), pairs.end(), [&](const Pair& p, const Pair& q) {
    return std::tuple(cells(p), p) < std::tuple(cells(q), q);
  });
  const HiddenPairs hidden(clusters, occlusion);
  std::vector<Pair> kept;
  for (std::size_t first = 0, end = 0; first < pairs.size(); first = end) {
    while (end < pairs.size() && cells(pairs[end]) == cells(pairs[first])) ++end;
    hidden.judge(std::span(pairs).subspan(first, end - first), kept);
    const double share = static_cast<double>(end) / static_cast<double>(pairs.size());
    report_progress(progress, "visibility", done_before + (1.0 - done_before) * share);
  }
  pairs = std::move(kept);
}

}  // namespace enfilade
