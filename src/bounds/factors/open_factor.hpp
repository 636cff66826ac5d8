// Bounds of the light that two polygons exchange where nothing stands between them.
#pragma once

#include "bounds/factors/pair_geometry.hpp"

namespace enfilade {

/// Bounds of the integral of K over both shapes, m2: area of either times its mean form factor to
/// the other. Both must lie in front of each other. K is a product of affine functions and r^-4,
/// which polynomials of r^2 bound from below and above (inverse_power.hpp); their integrals are
/// exact sums. Pairs that are close for their size are cut until the bounds differ by at most
/// `tolerance_m2` for each part, or `depth` times.
Range open_flux(const FlatShape& receiver, const FlatShape& shooter, double tolerance_m2,
                int depth);

}  // namespace enfilade
