// Where a building is not closed: gaps, open sides, and rooms that became part of the outside.
#pragma once

#include <span>
#include <vector>

#include "cells/partition/cell_complex.hpp"
#include "cells/rooms/leaf_cutter.hpp"

namespace enfilade {

enum class LeakKind {
  gap,        ///< a slit to the outside that no window leaves
  open_side,  ///< an opening to the outside that no wall frames: a wall is missing
  lost_room   ///< enclosed for the most part, but so open that it is taken as outside
};
/// "gap", "open side", "lost room".
const char* name_of(LeakKind kind);

struct Leak {
  LeakKind kind = LeakKind::gap;
  CellId cell;             ///< that leaks; the outside's for a lost room
  double area_m2 = 0.0;    ///< of the opening (0 for a lost room that does not lie at the border)
  double width_m = 0.0;    ///< its smallest width, of a ring's its parts' (likewise)
  std::vector<Vec3> path;  ///< from inside through the opening to the open
};

struct LeakConfig {
  /// A slit is narrower than this share of the cube root of its room's volume.
  double gap_share = 0.02;
  /// An open side is larger than this share of V^(2/3), and less of its rim is framed than of a
  /// door's (MergeConfig::framed_share).
  double side_share = 0.1, framed_share = 0.45;
  /// At the border of the scene's box, a room that lacks a whole wall is one leaf of whose boundary
  /// fronts are this share (of a cube, five of six), and no smaller than this share of a middling
  /// room.
  double border_front_share = 0.7, border_room_share = 0.25;
};

/// The leaks of cut groups, whose numbers stand for cells. `portals` are theirs, `border` is the
/// scene's box, `touches` tells the leaves at it, `lost` are leaves of rooms that became outside.
std::vector<Leak> find_leaks(const CutSpace& space, const LeafCutter& cutter,
                             std::span<const Portal> portals, const Region& border,
                             std::span<const char> touches, std::span<const std::uint32_t> lost,
                             const LeakConfig& config = {});

}  // namespace enfilade
