// Where two leaves of the partition touch: how much of it is open, and what each side sees of the
// rest.
#pragma once

#include <cstdint>
#include <vector>

#include "cells/partition/bsp.hpp"

namespace enfilade {

/// The common face of a leaf in front of a cut's plane and one behind it.
struct LeafInterface {
  std::uint32_t front_leaf = 0, back_leaf = 0;
  std::uint32_t plane = 0;  ///< index in the plane set
  std::uint32_t cut = 0;    ///< index in BspTree::cuts
  Vec3 n{0.0};              ///< of that plane
  double area_m2 = 0.0;
  double open_m2 = 0.0;           ///< not covered by anything that lies in the plane
  double faces_front_m2 = 0.0;    ///< covered by pieces that face the leaf in front
  double faces_back_m2 = 0.0;     ///< covered by pieces that face the leaf behind
  double framed_m2 = 0.0;         ///< of what is open: like a door (cells/partition/apertures.hpp)
  std::vector<Polygon> openings;  ///< convex, disjoint, together all that is open
};

/// All interfaces with an area, ordered by cut. Openness is never underestimated by more than
/// slivers thinner than `sliver_m`.
std::vector<LeafInterface> find_interfaces(const BspTree& tree, double sliver_m);

}  // namespace enfilade
