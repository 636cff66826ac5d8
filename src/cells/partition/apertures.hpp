// Apertures: what is open in one plane, and how much of it is framed like a door.
#pragma once

#include <span>

#include "cells/partition/interface.hpp"

namespace enfilade {

/// Sets `framed_m2` of all interfaces (ordered by cut). The openings that touch, between leaves
/// that are open to each other on both sides, are one aperture; it is framed where what lies beside
/// its rim in the plane is covered: all around a window, on three sides of a door, nowhere where a
/// plane merely crosses a room (there its rim ends on walls that stand on the plane).
void frame_apertures(std::span<LeafInterface> interfaces, const BspTree& tree, double tolerance_m);

}  // namespace enfilade
