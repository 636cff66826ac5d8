// A flight of stairs that stands in a room open to the next storey is a stairwell, a cell by
// itself.
#pragma once

#include "cells/rooms/leaf_cutter.hpp"

namespace enfilade {

struct StairwellConfig {
  /// A flight: treads in each quarter of the way up that together cover this share of its plan.
  double tread_share = 0.4;
  /// The stairwell takes at most this share of the two rooms: else they are one themselves.
  double rooms_share = 1.0 / 3.0;
};

/// What lies over and under a flight of stairs leaves the rooms that it joins, so that neither
/// reaches into the other's storey. A hole in a floor without a flight (an atrium, a gallery) stays
/// a portal between the two.
void cut_stairwells(CutSpace& space, LeafCutter& cutter, const StairwellConfig& config);

}  // namespace enfilade
