// Which groups of leaves should become one: groups that a wide opening joins, what is open to the
// outside, thin groups between others, furniture.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <tuple>
#include <vector>

#include "cells/merging/leaf_graph.hpp"
#include "cells/merging/leaf_merge.hpp"

namespace enfilade {

/// Why groups become one.
enum class MergeKind {
  rooms,            ///< a wide opening joins them, directly or across a thin group
  open_to_outside,  ///< one is the outside, and the other is open to it over a share of its
                    ///< boundary
  connectors,       ///< one is thin, and open to the other more than to any third
  enclosed_solids,  ///< one is solid and has most of its boundary in the other, a room (furniture)
};

/// Two groups to be joined, and the thin group between them that joins both where there is one.
struct MergeCandidate {
  static constexpr std::uint32_t no_group = 0xFFFFFFFFu;
  double score = 0.0;  ///< a share of a face or a boundary, or m2; more goes first
  /// Rooms: a < b. Open to the outside: a is the outside. Connectors and solids: a joins b.
  std::uint32_t a = 0, b = 0, via = no_group;
  std::uint32_t time = 0;  ///< of the judgement, counted in joins

  /// Scores that differ by rounding are equal.
  double level() const { return std::round(score * 1e6); }
  /// True where the other goes first.
  bool operator<(const MergeCandidate& o) const {
    if (level() != o.level()) return level() < o.level();
    return std::tie(a, b, via) > std::tie(o.a, o.b, o.via);
  }
};

/// Finds the candidates of a graph that the caller changes between calls. Keeps references to the
/// graph and the thresholds.
class MergeCandidates {
 public:
  MergeCandidates(const LeafGraph& graph, const MergeConfig& config);

  /// All candidates of a kind. Of rooms: those of groups that have changed since they were last
  /// found, and of their neighbours; a candidate that was found before is not told again.
  std::vector<MergeCandidate> find(MergeKind kind);
  /// The candidate between the groups that its groups have become part of, as it is now; nothing
  /// where it is none any more.
  std::optional<MergeCandidate> judge_again(MergeKind kind, const MergeCandidate& candidate) const;
  /// True where a group of the candidate has changed since the candidate was judged.
  bool has_changed(const MergeCandidate& candidate) const;
  /// To be called after each join, with the group that both have become.
  void mark_joined(std::uint32_t group);

 private:
  bool is_thin(const LeafGroup& g) const;
  bool is_connector(const LeafGroup& g) const;
  bool connects_to(const LeafGroup& g, std::uint32_t other) const;
  double room_score(std::uint32_t a, std::uint32_t b) const;
  double room_score(double open, double framed, double g_face, double h_face, const LeafGroup& g,
                    const LeafGroup& h) const;
  std::optional<MergeCandidate> room_across(std::uint32_t a, std::uint32_t b,
                                            std::uint32_t connector) const;
  std::optional<MergeCandidate> room_of(std::uint32_t a, std::uint32_t b) const;
  std::optional<MergeCandidate> outside_of(std::uint32_t group) const;
  std::optional<MergeCandidate> neighbour_of_connector(std::uint32_t group) const;
  std::optional<MergeCandidate> room_around(std::uint32_t solid, std::uint32_t room) const;
  std::vector<std::uint32_t> take_stale();
  void add_rooms_of(std::uint32_t group, std::vector<MergeCandidate>& out) const;

  const LeafGraph& graph_;
  const MergeConfig& config_;
  std::uint32_t joins_ = 0;
  std::vector<std::uint32_t> changed_at_;  ///< by group, counted in joins
  std::vector<std::uint32_t> changed_;     ///< groups, since rooms were last found
  std::vector<char> thin_;                 ///< by group
};

}  // namespace enfilade
