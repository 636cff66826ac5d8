// Irradiance smoothed over the patches' edges, for pictures; tables use the patches themselves.
#pragma once

#include <cstdint>
#include <span>

#include "hierarchy/patch_forest.hpp"

namespace enfilade {

/// Mean per band of the irradiance of `polygon` at p and at a pair of points to either side of p,
/// within about half a patch. An affine field stays as it is; a step between two patches becomes a
/// slope as wide as they are. `turn` in [0, 1) chooses the pair, so that the samples of a pixel,
/// with different turns, blend.
void smooth_irradiance(const PatchForest& forest, std::uint32_t polygon, const Vec3& p, double turn,
                       std::span<double> out);

}  // namespace enfilade
