// Cuts pieces that run on underneath or into solids: the covered parts are estimated to receive no
// light.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cells/partition/cell_complex.hpp"
#include "scene/scene.hpp"

namespace enfilade {

struct UnreachableConfig {
  int walks = 32;               ///< random walks that find no light from an unreachable part
  int max_bounces = 64;         ///< a walk that finds none in so many steps ends
  std::size_t max_parts = 128;  ///< a piece is cut into at most this many
  /// Steps of all walks together: some for any scene, and more for each piece. Buildings take 25 to
  /// 55 for each piece. Where these are not enough, as among sheets that all cross each other, what
  /// is left is taken to be reachable.
  std::uint64_t free_steps = 200'000, steps_per_piece = 100;
  double min_length_relative = 5e-4;  ///< shorter contacts do not cut, relative to the diagonal
  std::uint64_t seed = 1;
};

/// Large polygons (slabs, walls) run on underneath cupboards and into other solids. Polygons are
/// black from behind, so that those parts receive no light; but a patch that lies on both sides of
/// the line of contact would distribute its light evenly. Cuts each piece along the contacts that
/// separate reachable from unreachable parts, and along no other, and marks the parts that random
/// walks estimate to receive no light. No area is lost, the parts of a piece follow each other, and
/// a piece without such a contact stays whole. Repeatable for a seed. `tolerance_m` is the cells'.
std::vector<CellPiece> cut_unreachable_parts(const Scene& scene, std::span<const CellPiece> pieces,
                                             double tolerance_m, const UnreachableConfig& config);

}  // namespace enfilade
