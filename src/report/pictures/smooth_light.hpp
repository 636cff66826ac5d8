// Irradiance smoothed over the patches' edges, for pictures; tables use the patches themselves.
#pragma once

#include <cstdint>
#include <span>

#include "hierarchy/patch_forest.hpp"

namespace enfilade {

/// Mean per band of the irradiance of `polygon` at p and at pairs of points to either side of p,
/// about half a patch away. An affine field stays as it is; a step between two patches becomes a
/// slope as wide as they are. `turn` in [0, 1) turns the pairs about p, so that many samples blend.
void smooth_irradiance(const PatchForest& forest, std::uint32_t polygon, const Vec3& p, double turn,
                       std::span<double> out);

}  // namespace enfilade
