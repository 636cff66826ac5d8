// Merges leaves of the partition into cells: leaves that a wide opening joins are one room, leaves
// that a door joins are not.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cells/merging/room_kinds.hpp"
#include "cells/partition/interface.hpp"

namespace enfilade {

/// Thresholds are shares, so that they mean the same in any unit and size. Depths are a hair off
/// the round numbers that drawn niches and doorways like to have, so that no rounding decides.
struct MergeConfig {
  /// Two groups are one when the opening is this share of the geometric mean of their faces there:
  /// more than a door leaves of any wall, less than a partition of half height or the joint of an
  /// L.
  double open_share = 0.5;
  /// An opening with this share of its rim in a wall is a door, even where it is the whole face of
  /// the leaves that were merged so far.
  double framed_share = 0.45;
  /// A group that has grown by more than this share of its volume in a round joins nothing further
  /// in that round; the outside does.
  double round_growth = 0.01;
  /// A nook joins its room: it is open over nearly all of its face...
  double nook_open_share = 0.85;
  /// ... and not deeper than this many times the opening's width (an open corridor is).
  double nook_depth = 2.000001;
  /// A connector (the inside of a doorway, a window reveal) is thinner than this many times its
  /// opening's width.
  double connector_depth = 0.499999;
  /// A group that is open to the outside over this share of its whole boundary is outside.
  double outside_share = 0.3;
  /// ... and counts as a lost room where fronts of walls make up this share of its boundary, and
  /// its volume is no smaller than this share of a typical room's.
  double lost_front_share = 0.5, lost_room_share = 0.25;
  /// A solid with more than this share of its boundary in one room is furniture.
  double enclosed_share = 0.55;
  /// The smallest groups, up to this share of all enclosed volume, are no cells of their own.
  double crumb_share = 0.01;
  /// ... except for groups larger than this share of a typical room: a house of two hundred rooms
  /// would miss two.
  double crumb_room_share = 0.1;
  RoomConfig rooms;
};

struct LeafGroups {
  std::vector<std::uint32_t> group_of_leaf;  ///< numbered in the order of their first leaf
  std::vector<CellKind> kinds;               ///< by group
  /// One leaf for each group that became outside though it was the size of a room and closed for
  /// the most part.
  std::vector<std::uint32_t> lost;
};

/// `volume_m3` and `touches_outside` by leaf; the latter: the leaf reaches the border of the
/// enlarged bounding box.
LeafGroups merge_leaves(std::span<const double> volume_m3, std::span<const char> touches_outside,
                        std::span<const LeafInterface> interfaces, const MergeConfig& config);

}  // namespace enfilade
