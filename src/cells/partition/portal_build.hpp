// Openings between merged cells become few convex portals.
#pragma once

#include <span>
#include <vector>

#include "cells/partition/interface.hpp"
#include "cells/partition/plane_set.hpp"

namespace enfilade {

/// Returns, for every two cells and every plane between them, the convex hulls of openings that
/// touch, that is, lie nearer than `joint_m`. Ordered by cells, then by plane.
std::vector<Portal> build_portals(std::span<const LeafInterface> interfaces,
                                  std::span<const std::uint32_t> cell_of_leaf,
                                  std::span<const Plane> planes, double joint_m);

}  // namespace enfilade
