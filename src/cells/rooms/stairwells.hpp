// Stairwells: a flight of stairs in a room that is open to the next storey becomes a cell of its
// own.
#pragma once

#include "cells/rooms/leaf_cutter.hpp"

namespace enfilade {

struct StairwellConfig {
  /// A flight has treads in each quarter of its height that together cover this share of its plan.
  double tread_share = 0.4;
  /// The stairwell has at most this share of the two rooms' volume; otherwise the two are left as
  /// they are.
  double rooms_share = 1.0 / 3.0;
};

/// Cuts the space over and under each flight of stairs out of the rooms that it joins, so that
/// neither reaches into the other's storey. A hole in a floor without a flight (an atrium, a
/// gallery) stays a portal between the two.
void cut_stairwells(CutSpace& space, LeafCutter& cutter, const StairwellConfig& config);

}  // namespace enfilade
