// Rooms that are open to each other are parted where the floor or the ceiling has a step.
#pragma once

#include "cells/rooms/leaf_cutter.hpp"

namespace enfilade {

struct StepConfig {
  /// A step runs all across the room: along the floor (or ceiling) of this share of the section.
  double across_share = 0.9;
  /// A face that is higher than this share of the section is a barrier and not a step; it parts no
  /// rooms.
  double height_share = 0.25;
  /// Each part has at least this share of a typical room's volume...
  double part_share = 0.25;
  /// ... and is at least this deep in units of the root of the section's area, which a platform
  /// along a wall is not.
  double part_depth = 0.4;
};

/// Cuts rooms of `space` along steps. Builders lay another floor where another room begins, even
/// where the two are open to each other: its joint is a step of millimetres from wall to wall,
/// which furniture never makes.
void cut_at_steps(CutSpace& space, LeafCutter& cutter, const StepConfig& config);

}  // namespace enfilade
