// The binary space partition along the most occluding planes ([10] of the paper; Airey; Teller).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cells/partition/cell_complex.hpp"
#include "cells/partition/plane_set.hpp"
#include "geometry/convex.hpp"

namespace enfilade {

/// The part of a piece that lies in a node's plane.
struct InPlane {
  Polygon polygon;
  Box box;
  bool same_facing = true;  ///< faces the front of the node's plane
};

/// The cut of a node's region by its plane: the cross-section, and the pieces that cover it.
struct BspCut {
  std::int32_t node = -1;
  std::uint32_t plane = 0;  ///< index in the plane set
  Polygon section;
  std::vector<InPlane> covered_by;
};

struct BspTree {
  std::vector<BspNode> nodes;  ///< root first; at a leaf, `cell` is the leaf's number
  std::vector<BspCut> cuts;    ///< one for each inner node
  std::vector<Region> leaves;
};

/// Cuts `region`, which holds all pieces, until no plane covers `min_occlusion` of a region's
/// cross-section, or until there are `max_leaves`. Lengths to `tolerance_m`.
BspTree build_bsp(std::span<const Piece> pieces, const PlaneSet& planes, Region region,
                  const CellComplex::Config& config, double tolerance_m);

/// A leaf that a plane of the set runs through.
struct LeafAcross {
  std::uint32_t leaf = 0, plane = 0;
};

/// Cuts leaves by planes that run through them by more than the tolerance; a leaf may be cut by
/// several. The part behind a plane keeps the leaf's number. The pieces in the planes cover the
/// cuts.
void cut_leaves(BspTree& tree, std::span<const LeafAcross> cuts, std::span<const Piece> pieces,
                const PlaneSet& planes, double tolerance_m);

}  // namespace enfilade
