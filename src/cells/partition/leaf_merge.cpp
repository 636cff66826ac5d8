#include "cells/partition/leaf_merge.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace enfilade {
namespace {

constexpr std::uint32_t outside_group = LeafGraph::outside;

struct Candidate {
  double score = 0.0;
  std::uint32_t a = 0, b = 0, via = 0xFFFFFFFFu;  ///< via: the connector that joins a and b

  /// By score, as far as it is more than rounding.
  double level() const { return std::round(score * 1e6); }
  bool operator<(const Candidate& o) const {
    if (level() != o.level()) return level() > o.level();
    return std::tie(a, b, via) < std::tie(o.a, o.b, o.via);
  }
};

class Merger {
 public:
  Merger(std::span<const double> volume, std::span<const char> touches_outside,
         std::span<const LeafInterface> interfaces, const MergeConfig& config)
      : config_(config),
        graph_(volume, interfaces),
        stale_(graph_.size(), 1),
        thin_(graph_.size(), 0),
        room_candidates_of_(graph_.size()) {
    for (std::uint32_t i = 0; i < touches_outside.size(); ++i) {
      if (touches_outside[i]) graph_.join(outside_group, i + 1);
    }
  }

  void run() {
    while (round(&Merger::room_candidates)) {
    }
    typical_m3_ = typical_volume_m3(graph_);
    while (round(&Merger::outside_candidates)) {
    }
    // Thin groups between others go to the outside here and there; what that opens to it, follows.
    while (round(&Merger::leftover_candidates)) {
      while (round(&Merger::outside_candidates)) {
      }
    }
    while (leaking_solids()) {
    }
    while (round(&Merger::enclosed_solids)) {
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
        out.kinds.push_back(group == outside_group ? CellKind::outside
                            : is_room[group]       ? CellKind::room
                                                   : CellKind::solid);
      }
      out.group_of_leaf.push_back(at->second);
    }
    return out;
  }

 private:
  // A thin group between others: its depth is its volume over its opening.
  bool is_connector(const LeafGroup& g) const {
    const double opening = g.largest_opening();
    return opening > 0.0 && g.volume < config_.connector_depth * opening * std::sqrt(opening);
  }

  bool disagree(const LeafGroup& g, const LeafGroup& h) const {
    return g.has_evidence() && h.has_evidence() && g.is_solid() != h.is_solid();
  }

  // How much two touching groups are one room: 0 where they are not.
  double score(std::uint32_t a, std::uint32_t b) const {
    const LeafGroup& g = graph_[a];
    const LeafGroup& h = graph_[b];
    double open = 0.0, framed = 0.0, g_face = 0.0, h_face = 0.0;
    for (const auto& [side, contact] : g.contacts.at(b)) {
      open += contact.open;
      framed += contact.framed;
      g_face += g.faces.at(side);
      h_face += h.faces.at(side ^ 1u);
    }
    return share(open, framed, g_face, h_face, g, h);
  }

  double share(double open, double framed, double g_face, double h_face, const LeafGroup& g,
               const LeafGroup& h) const {
    if (open <= 0.0 || g_face <= 0.0 || h_face <= 0.0) return 0.0;
    const double mean = open / std::sqrt(g_face * h_face);
    const bool door = framed >= config_.framed_share * open;
    if (mean >= config_.open_share && !door) return std::min(mean, 1.0);
    const bool g_is_smaller = g.volume < h.volume;
    const LeafGroup& nook = g_is_smaller ? g : h;
    const double own = open / (g_is_smaller ? g_face : h_face);
    const double depth = nook.volume / open;
    const bool is_nook =
        own >= config_.nook_open_share && depth <= config_.nook_depth * std::sqrt(open);
    return is_nook ? mean : 0.0;
  }

  // A group's candidates hang on it and its neighbours alone: only where one of them has changed
  // they are looked for anew.
  void room_candidates(std::vector<Candidate>& out) const {
    for (std::uint32_t i = 1; i < graph_.size(); ++i) {
      if (stale_[i]) thin_[i] = graph_.alive(i) && is_connector(graph_[i]);
    }
    for (std::uint32_t i = 1; i < graph_.size(); ++i) {
      std::vector<Candidate>& own = room_candidates_of_[i];
      if (stale_[i]) {
        own.clear();
        if (graph_.alive(i)) room_candidates_of(i, own);
        stale_[i] = 0;
      }
      out.insert(out.end(), own.begin(), own.end());
    }
  }

  void room_candidates_of(std::uint32_t i, std::vector<Candidate>& out) const {
    for (const auto& [j, sides] : graph_[i].contacts) {
      if (j <= i || thin_[i] != thin_[j] || disagree(graph_[i], graph_[j])) continue;
      const double s = score(i, j);
      if (s > 0.0) out.push_back({s, i, j});
    }
    if (thin_[i]) through_connector(i, out);
  }

  // Two groups on both sides of a thin one are judged as if it were not there.
  void through_connector(std::uint32_t c, std::vector<Candidate>& out) const {
    struct Side {
      std::uint32_t group;
      double open, framed, face;
    };
    std::vector<Side> sides;
    for (const auto& [other, contacts] : graph_[c].contacts) {
      if (other == outside_group || thin_[other] || disagree(graph_[other], graph_[c])) continue;
      Side side{other, 0.0, 0.0, 0.0};
      for (const auto& [plane_side, contact] : contacts) {
        if (contact.open <= 0.0) continue;
        side.open += contact.open;
        side.framed += contact.framed;
        side.face += graph_[other].faces.at(plane_side ^ 1u);
      }
      if (side.open > 0.0) sides.push_back(side);
    }
    for (std::size_t i = 0; i < sides.size(); ++i) {
      for (std::size_t j = i + 1; j < sides.size(); ++j) {
        const LeafGroup& g = graph_[sides[i].group];
        const LeafGroup& h = graph_[sides[j].group];
        if (disagree(g, h)) continue;
        const double open = std::min(sides[i].open, sides[j].open);
        const double framed =
            0.5 * open * (sides[i].framed / sides[i].open + sides[j].framed / sides[j].open);
        const double s = share(open, framed, sides[i].face, sides[j].face, g, h);
        if (s > 0.0) out.push_back({s, sides[i].group, sides[j].group, c});
      }
    }
  }

  bool is_like_a_room(const LeafGroup& g) const {
    return typical_m3_ > 0.0 && g.volume >= config_.lost_room_share * typical_m3_ &&
           g.front >= config_.lost_front_share * g.boundary();
  }

  void outside_candidates(std::vector<Candidate>& out) const {
    for (const auto& [g, sides] : graph_[outside_group].contacts) {
      const LeafGroup& group = graph_[g];
      if (group.is_solid() || is_connector(group)) continue;
      const double whole = group.boundary(), open = group.open_to(outside_group);
      if (whole > 0.0 && open >= config_.outside_share * whole) {
        out.push_back({open / whole, outside_group, g});
      }
    }
  }

  // A connector that joins two rooms goes to the one that it is more open to; inside before
  // outside.
  void leftover_candidates(std::vector<Candidate>& out) const {
    for (std::uint32_t i = 1; i < graph_.size(); ++i) {
      if (!graph_.alive(i) || !is_connector(graph_[i])) continue;
      Candidate best;
      for (const auto& [j, sides] : graph_[i].contacts) {
        if (disagree(graph_[i], graph_[j])) continue;
        const double open = graph_[i].open_to(j);
        const double s = j == outside_group ? open * (1.0 - 1e-3) : open;
        if (s > best.score * (1.0 + 1e-6)) best = {s, std::min(i, j), std::max(i, j)};
      }
      if (best.score > 0.0) out.push_back(best);
    }
  }

  // A solid that is not tight is part of what it leaks to: no room is seen through a wall's cracks
  // then but through the other side's, and no portal leads into a wall.
  bool leaking_solids() {
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

  // Furniture stands in one room: a solid that has most of its boundary there is part of it. A wall
  // or a slab has at most half of it on one side.
  void enclosed_solids(std::vector<Candidate>& out) const {
    for (std::uint32_t i = 1; i < graph_.size(); ++i) {
      if (!graph_.alive(i) || !graph_[i].is_solid()) continue;
      const double whole = graph_[i].boundary();
      for (const auto& [j, sides] : graph_[i].contacts) {
        double touching = 0.0;
        for (const auto& [side, contact] : sides) touching += contact.area;
        if (!graph_[j].is_solid() && touching > config_.enclosed_share * whole) {
          out.push_back({touching, std::min(i, j), std::max(i, j)});
        }
      }
    }
  }

  // The smallest groups (the insides of furniture, gaps behind it) go to the neighbour that they
  // touch most, smallest first, until they hold the share of the volume that rooms do not miss.
  // More in one cell is always safe: what is in one cell is taken to see each other.
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
      if (g == outside_group || graph_[g].volume > config_.crumb_share * total) continue;
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
      if (target != g) graph_.join(g, target);
    }
  }

  void join(std::uint32_t g, std::uint32_t h) {
    graph_.join(g, h);
    if (g == outside_group) return;  // rooms are settled by then
    stale_[g] = stale_[h] = 1;
    for (const auto& [other, sides] : graph_[graph_.find(g)].contacts) stale_[other] = 1;
  }

  // One round: the best candidates first, each group in at most one. False when there was none.
  bool round(void (Merger::*find_candidates)(std::vector<Candidate>&) const) {
    std::vector<Candidate> candidates;
    (this->*find_candidates)(candidates);
    std::sort(candidates.begin(), candidates.end());
    std::vector<char> touched(graph_.size(), 0);
    for (const Candidate& c : candidates) {
      const bool has_via = c.via != 0xFFFFFFFFu;
      if (touched[c.a] || touched[c.b] || (has_via && touched[c.via])) continue;
      touched[c.a] = c.a != outside_group;
      touched[c.b] = 1;
      if (has_via) touched[c.via] = 1;
      if (c.a == outside_group && is_like_a_room(graph_[c.b])) lost_.push_back(c.b - 1);
      join(c.a, c.b);
      if (has_via) join(graph_.find(c.a), c.via);
    }
    return !candidates.empty();
  }

  MergeConfig config_;
  LeafGraph graph_;
  mutable std::vector<char> stale_, thin_;  ///< by group
  mutable std::vector<std::vector<Candidate>> room_candidates_of_;
  double typical_m3_ = 0.0;  ///< before anything becomes outside
  std::vector<std::uint32_t> lost_;
};

}  // namespace

LeafGroups merge_leaves(std::span<const double> volume_m3, std::span<const char> touches_outside,
                        std::span<const LeafInterface> interfaces, const MergeConfig& config) {
  Merger merger(volume_m3, touches_outside, interfaces, config);
  merger.run();
  return merger.result();
}

}  // namespace enfilade
