// Which groups of leaves should become one: groups that a wide opening joins, what is open to the
// outside, thin groups between others, furniture.
#pragma once

#include <cmath>
#include <cstdint>
#include <tuple>
#include <vector>

#include "cells/partition/leaf_graph.hpp"
#include "cells/partition/leaf_merge.hpp"

namespace enfilade {

/// Two groups to be joined, a < b, and the thin group between them that joins both where there is
/// one.
struct MergeCandidate {
  static constexpr std::uint32_t no_group = 0xFFFFFFFFu;
  double score = 0.0;  ///< a share of a face or a boundary, or m2; more goes first
  std::uint32_t a = 0, b = 0, via = no_group;

  /// Scores that differ by rounding are equal.
  double level() const { return std::round(score * 1e6); }
  bool operator<(const MergeCandidate& o) const {
    if (level() != o.level()) return level() > o.level();
    return std::tie(a, b, via) < std::tie(o.a, o.b, o.via);
  }
};

/// Finds the candidates of a graph that the caller changes between calls. Keeps references to the
/// graph and the thresholds.
class MergeCandidates {
 public:
  MergeCandidates(const LeafGraph& graph, const MergeConfig& config);

  /// Groups that are one room: a wide opening joins them, directly or across a thin group.
  std::vector<MergeCandidate> rooms();
  /// Groups that are open to the outside over a share of their boundary.
  std::vector<MergeCandidate> open_to_outside();
  /// Thin groups between others: each goes to the group that it is more open to, to a room before
  /// the outside.
  std::vector<MergeCandidate> connectors();
  /// Returns the solids that have most of their boundary in one room (furniture), with that room. A
  /// wall or a slab has at most half of its boundary on one side.
  std::vector<MergeCandidate> enclosed_solids();
  /// A group has changed: its candidates for a room, and those of its neighbours, are found anew.
  void mark_changed(std::uint32_t group) { stale_[group] = 1; }

 private:
  bool is_connector(const LeafGroup& g) const;
  double room_score(std::uint32_t a, std::uint32_t b) const;
  double room_score(double open, double framed, double g_face, double h_face, const LeafGroup& g,
                    const LeafGroup& h) const;
  void add_rooms_of(std::uint32_t group, std::vector<MergeCandidate>& out) const;
  void add_rooms_across(std::uint32_t connector, std::vector<MergeCandidate>& out) const;

  const LeafGraph& graph_;
  const MergeConfig& config_;
  std::vector<char> stale_, thin_;                     ///< by group
  std::vector<std::vector<MergeCandidate>> rooms_of_;  ///< by group, as last found
};

}  // namespace enfilade
