// Rooms that are open to each other part where the floor or the ceiling has a step.
#pragma once

#include "cells/rooms/leaf_cutter.hpp"

namespace enfilade {

struct StepConfig {
  /// A step runs all across the room: below (or above) this share of the section.
  double across_share = 0.9;
  /// What is higher than this share of the section is no step but a barrier, and no border.
  double height_share = 0.25;
  /// Each part has at least this share of a typical room's volume...
  double part_share = 0.25;
  /// ... and is at least so deep, beside the root of the section's area: no platform along a wall.
  double part_depth = 0.4;
};

/// Builders lay another floor where another room begins, be it open to the first: a joint with a
/// step of millimetres from wall to wall, as furniture never has one.
void cut_at_steps(CutSpace& space, LeafCutter& cutter, const StepConfig& config);

}  // namespace enfilade
