// Leaks of a building: gaps, open sides, and rooms that became part of the outside.
#pragma once

#include <span>
#include <vector>

#include "cells/partition/cell_complex.hpp"
#include "cells/rooms/leaf_cutter.hpp"

namespace enfilade {

enum class LeakKind {
  gap,        ///< a slit to the outside that does not lie beside a window
  open_side,  ///< an opening to the outside that no wall frames: a wall is missing
  lost_room   ///< a room enclosed for the most part, but so open that it became outside
};
/// "gap", "open side", "lost room".
const char* name_of(LeakKind kind);

struct Leak {
  LeakKind kind = LeakKind::gap;
  CellId cell;             ///< the cell that leaks; for a lost room the outside
  double area_m2 = 0.0;    ///< of the opening; 0 for a lost room that does not lie at the border
  double width_m = 0.0;    ///< smallest width of the opening, of a ring that of its parts; or 0
  std::vector<Vec3> path;  ///< from inside through the opening to the open
};

struct LeakConfig {
  /// A slit is narrower than this share of the cube root of its room's volume.
  double gap_share = 0.02;
  /// An open side is larger than this share of V^(2/3), and less of its rim is framed than of a
  /// door's (MergeConfig::framed_share).
  double side_share = 0.1, framed_share = 0.45;
  /// At the border of the scene's box, a room that lacks a whole wall is one leaf: fronts make up
  /// this share of its boundary (of a cube's, five sixths), and its volume is at least this share
  /// of the median room's.
  double border_front_share = 0.7, border_room_share = 0.25;
};

/// Returns the leaks of the groups, whose numbers stand for cells: by group, the largest of each
/// kind; then the lost rooms. `portals` join the groups, `border` is the scene's enlarged box,
/// `touches_border[leaf]` says whether the leaf reaches it, `lost` are leaves of rooms that became
/// outside.
std::vector<Leak> find_leaks(const CutSpace& space, const LeafCutter& cutter,
                             std::span<const Portal> portals, const Region& border,
                             std::span<const char> touches_border,
                             std::span<const std::uint32_t> lost, const LeakConfig& config = {});

}  // namespace enfilade
