// In phases: rooms, the outside, thin groups, solids; within a phase the best candidate first.
#include "cells/merging/leaf_merge.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <queue>
#include <utility>

#include "cells/merging/merge_candidates.hpp"

namespace enfilade {
namespace {

class Merger {
 public:
  Merger(std::span<const double> volume, std::span<const char> touches_outside,
         std::span<const LeafInterface> interfaces, const MergeConfig& config)
      : config_(config), graph_(volume, interfaces), candidates_(graph_, config_) {
    for (std::uint32_t i = 0; i < touches_outside.size(); ++i) {
      if (touches_outside[i]) graph_.join(LeafGraph::outside, i + 1);
    }
  }

  void run() {
    while (round(MergeKind::rooms)) {
    }
    typical_m3_ = typical_volume_m3(graph_);
    while (round(MergeKind::open_to_outside)) {
    }
    // Some thin groups go to the outside, which may open others to it.
    while (round(MergeKind::connectors)) {
      while (round(MergeKind::open_to_outside)) {
      }
    }
    while (join_leaking_solids()) {
    }
    while (round(MergeKind::enclosed_solids)) {
    }
    join_crumbs();
  }

  LeafGroups result() {
    LeafGroups out;
    out.lost = lost_;
    const std::vector<char> is_room = find_rooms(graph_, config_.rooms);
    std::map<std::uint32_t, std::uint32_t> number;
    for (std::uint32_t leaf = 1; leaf < graph_.size(); ++leaf) {
      const std::uint32_t group = graph_.find(leaf);
      const auto [at, is_new] =
          number.try_emplace(group, static_cast<std::uint32_t>(out.kinds.size()));
      if (is_new) {
        out.kinds.push_back(group == LeafGraph::outside ? CellKind::outside
                            : is_room[group]            ? CellKind::room
                                                        : CellKind::solid);
      }
      out.group_of_leaf.push_back(at->second);
    }
    return out;
  }

 private:
  bool is_like_a_room(const LeafGroup& g) const {
    return typical_m3_ > 0.0 && g.volume >= config_.lost_room_share * typical_m3_ &&
           g.front >= config_.lost_front_share * g.boundary();
  }

  // A solid that is not tight is part of what it leaks to: otherwise rooms would see each other
  // through a wall's cracks, and portals would lead into walls. False when there was none.
  bool join_leaking_solids() {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> leaks;
    for (std::uint32_t i = 1; i < graph_.size(); ++i) {
      if (!graph_.alive(i) || !graph_[i].is_solid()) continue;
      double most = 0.0;
      std::uint32_t into = i;
      for (const auto& [j, sides] : graph_[i].contacts) {
        const double open = graph_[i].open_to(j);
        if (open > most * (1.0 + 1e-6)) {
          most = open;
          into = j;
        }
      }
      if (into != i) leaks.emplace_back(i, into);
    }
    for (const auto& [i, into] : leaks) graph_.join(graph_.find(into), graph_.find(i));
    return !leaks.empty();
  }

  // The smallest groups (the insides of furniture, gaps behind it) go to the neighbour that they
  // touch most, smallest first, until together they hold `crumb_share` of the volume. More in one
  // cell is always safe: what is in one cell is taken to see each other.
  void join_crumbs() {
    std::vector<std::pair<double, std::uint32_t>> by_volume;
    double total = 0.0;
    for (std::uint32_t i = 1; i < graph_.size(); ++i) {
      if (!graph_.alive(i)) continue;
      by_volume.emplace_back(graph_[i].volume, i);
      total += graph_[i].volume;
    }
    std::stable_sort(by_volume.begin(), by_volume.end(), [&](const auto& a, const auto& b) {
      return std::round(1e9 * a.first / total) < std::round(1e9 * b.first / total);
    });
    const double largest = config_.crumb_room_share * typical_volume_m3(graph_);
    double crumbs = 0.0;
    for (const auto& [volume, i] : by_volume) {
      crumbs += volume;
      if (crumbs > config_.crumb_share * total || volume > largest) break;
      const std::uint32_t g = graph_.find(i);
      if (g == LeafGraph::outside || graph_[g].volume > config_.crumb_share * total) continue;
      const std::uint32_t target = most_touched(g);
      if (target != g) graph_.join(g, target);
    }
  }

  // The neighbour with the largest common face; the group itself where it has none.
  std::uint32_t most_touched(std::uint32_t g) const {
    double most = 0.0;
    std::uint32_t target = g;
    for (const auto& [other, sides] : graph_[g].contacts) {
      double area = 0.0;
      for (const auto& [side, contact] : sides) area += contact.area;
      if (area > most * (1.0 + 1e-9)) {
        most = area;
        target = other;
      }
    }
    return target;
  }

  void join(std::uint32_t g, std::uint32_t h) {
    graph_.join(g, h);
    candidates_.mark_joined(graph_.find(g));
  }

  // One round: the best candidates first. A group that has grown much waits for the next round, so
  // that groups of like size find each other; a large one takes any number of small ones. Where a
  // group of a candidate has changed, the candidate is judged anew. False when there was none.
  bool round(MergeKind kind) {
    std::priority_queue<MergeCandidate> queue({}, candidates_.find(kind));
    std::map<std::uint32_t, double> limit_m3;  // by group that has grown in this round
    const auto waits = [&](std::uint32_t g) {
      const auto at = limit_m3.find(g);
      return at != limit_m3.end() && graph_[g].volume > at->second;
    };
    bool has_joined = false;
    while (!queue.empty()) {
      const MergeCandidate c = queue.top();
      queue.pop();
      const bool has_via = c.via != MergeCandidate::no_group;
      if (waits(graph_.find(c.a)) || waits(graph_.find(c.b))) continue;
      if (has_via && waits(graph_.find(c.via))) continue;
      if (candidates_.has_changed(c)) {
        const auto again = candidates_.judge_again(kind, c);
        if (again) queue.push(*again);
        continue;
      }
      note_lost(c);
      const double larger_m3 = std::max(graph_[c.a].volume, graph_[c.b].volume);
      double limit = (1.0 + config_.round_growth) * larger_m3;
      for (const std::uint32_t g : {c.a, c.b}) {
        const auto at = limit_m3.find(g);
        if (at != limit_m3.end()) limit = std::min(limit, at->second);
      }
      join(c.a, c.b);
      if (has_via) join(c.a, c.via);
      const std::uint32_t joined = graph_.find(c.a);
      if (joined != LeafGraph::outside) limit_m3[joined] = limit;
      has_joined = true;
    }
    return has_joined;
  }

  void note_lost(const MergeCandidate& c) {
    if (c.a != LeafGraph::outside && c.b != LeafGraph::outside) return;
    const std::uint32_t joins = c.a == LeafGraph::outside ? c.b : c.a;
    if (is_like_a_room(graph_[joins])) lost_.push_back(joins - 1);
  }

  MergeConfig config_;
  LeafGraph graph_;
  MergeCandidates candidates_;
  double typical_m3_ = 0.0;          ///< before anything becomes outside
  std::vector<std::uint32_t> lost_;  ///< a leaf each of what LeafGroups::lost lists
};

}  // namespace

LeafGroups merge_leaves(std::span<const double> volume_m3, std::span<const char> touches_outside,
                        std::span<const LeafInterface> interfaces, const MergeConfig& config) {
  Merger merger(volume_m3, touches_outside, interfaces, config);
  merger.run();
  return merger.result();
}

}  // namespace enfilade
