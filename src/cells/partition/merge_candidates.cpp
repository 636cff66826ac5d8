#include "cells/partition/merge_candidates.hpp"

#include <algorithm>

namespace enfilade {
namespace {

/// Among openings of equal size a room comes before the outside.
constexpr double outside_handicap = 1e-3;
/// Openings count as larger only by more than opening_rounding.
constexpr double opening_rounding = 1e-6;

bool disagree(const LeafGroup& g, const LeafGroup& h) {
  return g.has_evidence() && h.has_evidence() && g.is_solid() != h.is_solid();
}

}  // namespace

MergeCandidates::MergeCandidates(const LeafGraph& graph, const MergeConfig& config)
    : graph_(graph),
      config_(config),
      stale_(graph.size(), 1),
      thin_(graph.size(), 0),
      rooms_of_(graph.size()) {}

// The depth of a thin group is its volume over its opening.
bool MergeCandidates::is_connector(const LeafGroup& g) const {
  const double opening = g.largest_opening();
  return opening > 0.0 && g.volume < config_.connector_depth * opening * std::sqrt(opening);
}

// How much two touching groups are one room: 0 where they are not.
double MergeCandidates::room_score(std::uint32_t a, std::uint32_t b) const {
  const LeafGroup& g = graph_[a];
  const LeafGroup& h = graph_[b];
  double open = 0.0, framed = 0.0, g_face = 0.0, h_face = 0.0;
  for (const auto& [side, contact] : g.contacts.at(b)) {
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

// A group's candidates depend on the group and its neighbours alone: they are found anew only where
// one of these has changed.
std::vector<MergeCandidate> MergeCandidates::rooms() {
  std::vector<MergeCandidate> all;
  for (std::uint32_t i = 1; i < graph_.size(); ++i) {
    if (stale_[i]) thin_[i] = graph_.alive(i) && is_connector(graph_[i]);
  }
  for (std::uint32_t i = 1; i < graph_.size(); ++i) {
    std::vector<MergeCandidate>& own = rooms_of_[i];
    if (stale_[i]) {
      own.clear();
      if (graph_.alive(i)) add_rooms_of(i, own);
      stale_[i] = 0;
    }
    all.insert(all.end(), own.begin(), own.end());
  }
  return all;
}

void MergeCandidates::add_rooms_of(std::uint32_t i, std::vector<MergeCandidate>& out) const {
  for (const auto& [j, sides] : graph_[i].contacts) {
    if (j <= i || thin_[i] != thin_[j] || disagree(graph_[i], graph_[j])) continue;
    const double score = room_score(i, j);
    if (score > 0.0) out.push_back({score, i, j});
  }
  if (thin_[i]) add_rooms_across(i, out);
}

// Two groups on both sides of a thin one are judged as if it were not there.
void MergeCandidates::add_rooms_across(std::uint32_t c, std::vector<MergeCandidate>& out) const {
  struct Side {
    std::uint32_t group;
    double open, framed, face;
  };
  std::vector<Side> sides;
  for (const auto& [other, contacts] : graph_[c].contacts) {
    if (other == LeafGraph::outside || thin_[other] || disagree(graph_[other], graph_[c])) continue;
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
      const double score = room_score(open, framed, sides[i].face, sides[j].face, g, h);
      if (score > 0.0) out.push_back({score, sides[i].group, sides[j].group, c});
    }
  }
}

std::vector<MergeCandidate> MergeCandidates::open_to_outside() {
  std::vector<MergeCandidate> all;
  for (const auto& [g, sides] : graph_[LeafGraph::outside].contacts) {
    const LeafGroup& group = graph_[g];
    if (group.is_solid() || is_connector(group)) continue;
    const double whole = group.boundary(), open = group.open_to(LeafGraph::outside);
    if (whole > 0.0 && open >= config_.outside_share * whole) {
      all.push_back({open / whole, LeafGraph::outside, g});
    }
  }
  return all;
}

std::vector<MergeCandidate> MergeCandidates::connectors() {
  std::vector<MergeCandidate> all;
  for (std::uint32_t i = 1; i < graph_.size(); ++i) {
    if (!graph_.alive(i) || !is_connector(graph_[i])) continue;
    MergeCandidate best;
    for (const auto& [j, sides] : graph_[i].contacts) {
      if (disagree(graph_[i], graph_[j])) continue;
      const double open = graph_[i].open_to(j);
      const double score = j == LeafGraph::outside ? open * (1.0 - outside_handicap) : open;
      if (score > best.score * (1.0 + opening_rounding))
        best = {score, std::min(i, j), std::max(i, j)};
    }
    if (best.score > 0.0) all.push_back(best);
  }
  return all;
}

std::vector<MergeCandidate> MergeCandidates::enclosed_solids() {
  std::vector<MergeCandidate> all;
  for (std::uint32_t i = 1; i < graph_.size(); ++i) {
    if (!graph_.alive(i) || !graph_[i].is_solid()) continue;
    const double whole = graph_[i].boundary();
    for (const auto& [j, sides] : graph_[i].contacts) {
      double touching = 0.0;
      for (const auto& [side, contact] : sides) touching += contact.area;
      if (!graph_[j].is_solid() && touching > config_.enclosed_share * whole) {
        all.push_back({touching, std::min(i, j), std::max(i, j)});
      }
    }
  }
  return all;
}

}  // namespace enfilade
