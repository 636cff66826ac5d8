// The common faces of two leaves of the partition: how much of each is open, and how much of the
// rest faces either side.
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
  double framed_m2 = 0.0;         ///< open and framed like a door (cells/partition/apertures.hpp)
  std::vector<Polygon> openings;  ///< convex, disjoint; together they cover all that is open

  /// Returns the leaf on the other side of the face.
  std::uint32_t other_than(std::uint32_t leaf) const {
    return front_leaf == leaf ? back_leaf : front_leaf;
  }
};

double total_area_m2(const std::vector<Polygon>& polygons);

/// Returns all interfaces with an area, ordered by cut. Openness is never underestimated by more
/// than slivers thinner than `sliver_m`.
std::vector<LeafInterface> find_interfaces(const BspTree& tree, double sliver_m);

}  // namespace enfilade
