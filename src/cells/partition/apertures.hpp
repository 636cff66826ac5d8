// Apertures: the openings of one plane, and how much of each is framed like a door.
#pragma once

#include <span>
#include <vector>

#include "cells/partition/bsp.hpp"
#include "cells/partition/interface.hpp"
#include "cells/partition/plane_set.hpp"

namespace enfilade {

struct ApertureConfig {
  Vec3 up{0.0};              ///< at right angles to most floors, of either sign
  double tolerance_m = 0.0;  ///< of all lengths
  double door_share = 0.0;   ///< an aperture with that share of its rim framed is a door
  /// A plane is upright where its normal's part along up is less. The rims of furniture and
  /// skirtings frame level sections of whole rooms.
  double upright = 0.1;
};

/// Sets `framed_m2` of all interfaces. Openings of one plane that touch, and the sections of leaves
/// that lie across an upright plane between them, are one aperture where the leaves on each side of
/// them are open to each other. An aperture is framed as far as polygons beside its rim cover the
/// plane and border on what lies before or behind it: all around a window, on three sides of a
/// door, nowhere where a plane merely crosses a room (there its rim ends on walls that stand on the
/// plane, or on joints within a floor).
///
/// Returns the leaves that lie across a door, with the door's plane. Such a leaf is a part of the
/// rooms on both sides, and has to be cut.
std::vector<LeafAcross> frame_apertures(std::span<LeafInterface> interfaces, const BspTree& tree,
                                        const PlaneSet& planes, const ApertureConfig& config);

}  // namespace enfilade
