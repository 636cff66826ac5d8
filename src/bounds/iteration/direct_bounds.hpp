// Bounds of the irradiance that lights without an opening give directly.
#pragma once

#include "bounds/factors/pair_factor.hpp"
#include "bounds/iteration/row_bounds.hpp"
#include "scene/scene.hpp"

namespace enfilade {

/// Bounds of a light's intensity (the scene's power unit per sr) in one band over all directions to
/// points of the receiver. Of a light with a distribution the lower bound is 0.
Range intensity_towards(const LightSource& light, std::size_t band, const FlatShape& receiver);

/// Bounds of cos / r^2 (1/m2) of a point light, visibility included, over the points of a receiver
/// and for their mean: irradiance per intensity. With h the light's height above the receiver's
/// plane this is h / r^3, whose mean over each visible part is bounded by polynomials of r^2. The
/// visible parts are exact unless more than 200 occluders stand between.
LightRange direct_bounds(const Vec3& light, const PatchOfPolygon& receiver,
                         const PairFactors& scene);

}  // namespace enfilade
