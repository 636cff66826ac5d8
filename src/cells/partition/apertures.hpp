// Apertures: the openings of one plane, and how much of each is framed like a door.
#pragma once

#include <span>

#include "cells/partition/interface.hpp"

namespace enfilade {

/// Sets `framed_m2` of all interfaces (ordered by cut; lengths to `tolerance_m`). Openings that
/// touch are one aperture where the leaves on each side of them are open to each other. An aperture
/// is framed as far as polygons cover the plane beside its rim: all around a window, on three sides
/// of a door, nowhere where a plane merely crosses a room (there its rim ends on walls that stand
/// on the plane).
void frame_apertures(std::span<LeafInterface> interfaces, const BspTree& tree, double tolerance_m);

}  // namespace enfilade
