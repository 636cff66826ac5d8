#include "cells/merging/merge_candidates.hpp"

#include <algorithm>
#include <numeric>

namespace enfilade {
namespace {

/// Among openings of equal size a room comes before the outside.
constexpr double outside_handicap = 1e-3;
/// Openings count as larger only by more than opening_rounding.
constexpr double opening_rounding = 1e-6;

bool disagree(const LeafGroup& g, const LeafGroup& h) {
  return g.has_evidence() && h.has_evidence() && g.is_solid() != h.is_solid();
}

/// What two groups share, m2: their openings, and the face of the second group around these.
struct OpenSide {
  double open = 0.0, framed = 0.0, face = 0.0;

  /// From the group `of` to its neighbour.
  OpenSide(const LeafGraph& graph, const LeafGroup& of, std::uint32_t neighbour) {
    const auto at = of.contacts.find(neighbour);
    if (at == of.contacts.end()) return;
    for (const auto& [side, contact] : at->second) {
      if (contact.open <= 0.0) continue;
      open += contact.open;
      framed += contact.framed;
      face += graph[neighbour].faces.at(side ^ 1u);
    }
  }
};

}  // namespace

MergeCandidates::MergeCandidates(const LeafGraph& graph, const MergeConfig& config)
    : graph_(graph),
      config_(config),
      changed_at_(graph.size(), 0),
      changed_(graph.size()),
      thin_(graph.size(), 0) {
  std::iota(changed_.begin(), changed_.end(), 0u);
}

std::vector<MergeCandidate> MergeCandidates::find(MergeKind kind) {
  std::vector<MergeCandidate> all;
  const auto add = [&all](const std::optional<MergeCandidate>& candidate) {
    if (candidate) all.push_back(*candidate);
  };
  if (kind == MergeKind::rooms) {
    for (const std::uint32_t i : take_stale()) add_rooms_of(i, all);
    return all;
  }
  if (kind == MergeKind::open_to_outside) {
    for (const auto& [g, sides] : graph_[LeafGraph::outside].contacts) add(outside_of(g));
    return all;
  }
  for (std::uint32_t i = 1; i < graph_.size(); ++i) {
    if (!graph_.alive(i)) continue;
    if (kind == MergeKind::connectors) add(neighbour_of_connector(i));
    if (kind != MergeKind::enclosed_solids || !graph_[i].is_solid()) continue;
    for (const auto& [j, sides] : graph_[i].contacts) add(room_around(i, j));
  }
  return all;
}

std::optional<MergeCandidate> MergeCandidates::judge_again(MergeKind kind,
                                                           const MergeCandidate& c) const {
  const std::uint32_t a = graph_.find(c.a), b = graph_.find(c.b);
  if (a == b) return {};
  switch (kind) {
    case MergeKind::rooms:
      if (c.via == MergeCandidate::no_group) return room_of(std::min(a, b), std::max(a, b));
      if (!graph_.alive(c.via)) return {};
      return room_across(std::min(a, b), std::max(a, b), c.via);
    case MergeKind::open_to_outside:
      return outside_of(b);
    case MergeKind::connectors:
      return a == c.a ? neighbour_of_connector(a) : std::nullopt;
    case MergeKind::enclosed_solids:
      return a == c.a ? room_around(a, b) : std::nullopt;
  }
  return {};
}

bool MergeCandidates::has_changed(const MergeCandidate& c) const {
  const auto changed = [&](std::uint32_t g) { return !graph_.alive(g) || changed_at_[g] > c.time; };
  return changed(c.a) || changed(c.b) || (c.via != MergeCandidate::no_group && changed(c.via));
}

void MergeCandidates::mark_joined(std::uint32_t group) {
  changed_at_[group] = ++joins_;
  if (group == LeafGraph::outside) return;  // which joins no room
  changed_.push_back(group);
  thin_[group] = is_thin(graph_[group]);
}

// The depth of a thin group is its volume over its opening.
bool MergeCandidates::is_thin(const LeafGroup& g) const {
  return g.opens_over(std::pow(g.volume / config_.connector_depth, 2.0 / 3.0));
}

// Of a thin group. A cavity that has many small openings, to different groups, connects none.
bool MergeCandidates::connects_to(const LeafGroup& g, std::uint32_t other) const {
  const double least_m2 = std::pow(g.volume / config_.connector_depth, 2.0 / 3.0);
  return g.open_to(other) > least_m2;
}

bool MergeCandidates::is_connector(const LeafGroup& g) const {
  return is_thin(g) && std::any_of(g.contacts.begin(), g.contacts.end(), [&](const auto& contact) {
           return connects_to(g, contact.first);
         });
}

// How much two touching groups are one room: 0 where they are not.
double MergeCandidates::room_score(std::uint32_t a, std::uint32_t b) const {
  const LeafGroup& g = graph_[a];
  const LeafGroup& h = graph_[b];
  const auto at = g.contacts.find(b);
  if (at == g.contacts.end()) return 0.0;
  double open = 0.0, framed = 0.0, g_face = 0.0, h_face = 0.0;
  for (const auto& [side, contact] : at->second) {
    open += contact.open;
    framed += contact.framed;
    g_face += g.faces.at(side);
    h_face += h.faces.at(side ^ 1u);
  }
  return room_score(open, framed, g_face, h_face, g, h);
}

double MergeCandidates::room_score(double open, double framed, double g_face, double h_face,
                                   const LeafGroup& g, const LeafGroup& h) const {
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

// A group's candidates depend on the group and its neighbours alone.
std::vector<std::uint32_t> MergeCandidates::take_stale() {
  std::vector<std::uint32_t> stale;
  for (const std::uint32_t i : changed_) {
    if (i == LeafGraph::outside || !graph_.alive(i)) continue;
    stale.push_back(i);
    for (const auto& [j, sides] : graph_[i].contacts) {
      if (j != LeafGraph::outside) stale.push_back(j);
    }
  }
  changed_.clear();
  std::sort(stale.begin(), stale.end());
  stale.erase(std::unique(stale.begin(), stale.end()), stale.end());
  for (const std::uint32_t i : stale) thin_[i] = is_thin(graph_[i]);
  return stale;
}

void MergeCandidates::add_rooms_of(std::uint32_t i, std::vector<MergeCandidate>& out) const {
  std::vector<std::uint32_t> sides;  // of a thin group
  for (const auto& [j, contacts] : graph_[i].contacts) {
    if (j > i) {
      if (const auto room = room_of(i, j)) out.push_back(*room);
    }
    if (thin_[i] && j != LeafGraph::outside && !thin_[j] && connects_to(graph_[i], j))
      sides.push_back(j);
  }
  for (std::size_t k = 0; k < sides.size(); ++k) {
    for (std::size_t l = k + 1; l < sides.size(); ++l) {
      if (const auto room = room_across(sides[k], sides[l], i)) out.push_back(*room);
    }
  }
}

std::optional<MergeCandidate> MergeCandidates::room_of(std::uint32_t a, std::uint32_t b) const {
  if (thin_[a] != thin_[b] || disagree(graph_[a], graph_[b])) return {};
  const double score = room_score(a, b);
  if (score <= 0.0) return {};
  return MergeCandidate{score, a, b, MergeCandidate::no_group, joins_};
}

// Two groups on both sides of a thin one are judged as if it were not there.
std::optional<MergeCandidate> MergeCandidates::room_across(std::uint32_t a, std::uint32_t b,
                                                           std::uint32_t c) const {
  if (!thin_[c] || thin_[a] || thin_[b]) return {};
  const LeafGroup &g = graph_[a], &h = graph_[b], &between = graph_[c];
  if (disagree(g, h) || disagree(g, between) || disagree(h, between)) return {};
  const OpenSide to_g(graph_, between, a), to_h(graph_, between, b);
  if (to_g.open <= 0.0 || to_h.open <= 0.0) return {};
  const double open = std::min(to_g.open, to_h.open);
  // A cavity that runs all through a wall is not between the two.
  if (between.volume >= config_.connector_depth * open * std::sqrt(open)) return {};
  const double framed = 0.5 * open * (to_g.framed / to_g.open + to_h.framed / to_h.open);
  const double score = room_score(open, framed, to_g.face, to_h.face, g, h);
  if (score <= 0.0) return {};
  return MergeCandidate{score, a, b, c, joins_};
}

std::optional<MergeCandidate> MergeCandidates::outside_of(std::uint32_t g) const {
  const LeafGroup& group = graph_[g];
  if (group.is_solid() || is_connector(group)) return {};
  const double whole = group.boundary(), open = group.open_to(LeafGraph::outside);
  if (whole <= 0.0 || open < config_.outside_share * whole) return {};
  return MergeCandidate{open / whole, LeafGraph::outside, g, MergeCandidate::no_group, joins_};
}

// A thin group goes to the group that it is more open to, to a room before the outside.
std::optional<MergeCandidate> MergeCandidates::neighbour_of_connector(std::uint32_t i) const {
  if (!is_thin(graph_[i])) return {};
  MergeCandidate best{0.0, i, i, MergeCandidate::no_group, joins_};
  for (const auto& [j, sides] : graph_[i].contacts) {
    if (disagree(graph_[i], graph_[j]) || !connects_to(graph_[i], j)) continue;
    const double open = graph_[i].open_to(j);
    const double score = j == LeafGraph::outside ? open * (1.0 - outside_handicap) : open;
    if (score <= best.score * (1.0 + opening_rounding)) continue;
    best.score = score;
    best.b = j;
  }
  if (best.score <= 0.0) return {};
  return best;
}

// A wall or a slab has at most half of its boundary on one side.
std::optional<MergeCandidate> MergeCandidates::room_around(std::uint32_t solid,
                                                           std::uint32_t room) const {
  const LeafGroup& group = graph_[solid];
  const auto at = group.contacts.find(room);
  if (!group.is_solid() || graph_[room].is_solid() || at == group.contacts.end()) return {};
  double touching = 0.0;
  for (const auto& [side, contact] : at->second) touching += contact.area;
  if (touching <= config_.enclosed_share * group.boundary()) return {};
  return MergeCandidate{touching, solid, room, MergeCandidate::no_group, joins_};
}

}  // namespace enfilade
