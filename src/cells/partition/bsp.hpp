// The binary space partition along the most occluding planes ([10] of the paper; Airey; Teller).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cells/partition/cell_complex.hpp"
#include "cells/partition/plane_set.hpp"
#include "geometry/convex.hpp"

namespace enfilade {

/// Part of a piece that lies in a node's plane.
struct InPlane {
  Polygon polygon;
  Box box;
  bool same_facing = true;  ///< as the node's plane
};

/// What a cut through a region looks like: its cross-section and what covers it.
struct BspCut {
  std::int32_t node = -1;
  std::uint32_t plane = 0;  ///< index in the plane set
  Polygon section;
  std::vector<InPlane> covered_by;
};

struct BspTree {
  std::vector<BspNode> nodes;  ///< root first; at a leaf, `cell` is the leaf's number
  std::vector<BspCut> cuts;    ///< one an inner node
  std::vector<Region> leaves;
};

/// Cuts `region` until no plane covers `min_occlusion` of its cross-section.
BspTree build_bsp(std::span<const Piece> pieces, const PlaneSet& planes, Region region,
                  const CellComplex::Config& config, double tolerance_m);

}  // namespace enfilade
