// Bounds of the irradiance that point lights give directly.
#pragma once

#include "bounds/factors/pair_factor.hpp"
#include "bounds/iteration/row_bounds.hpp"
#include "scene/scene.hpp"

namespace enfilade {

/// Bounds of a light's intensity (the scene's power unit per sr) in one band over all directions to
/// points of the receiver.
/// Known exactly of an isotropic light; of others from above alone.
Range intensity_towards(const LightSource& light, std::size_t band, const FlatShape& receiver);

/// The same as direct_bounds for a light that is spread over an opening, from above alone: as if
/// all of it came from the worst place of the opening. Throws InputError where the opening touches
/// the receiver, so that there is no bound.
LightRange opening_bounds(const LightSource& light, const PatchOfPolygon& receiver,
                          const PairFactors& scene);

/// Bounds of cos / r^2 (1/m2) of a point light, visibility included, over the points of a receiver
/// and for their mean: irradiance per intensity. With h the light's height above the receiver's
/// plane this is h / r^3, whose mean over each visible part is bounded by polynomials of r^2. The
/// visible parts are exact unless more than 200 occluders stand between.
LightRange direct_bounds(const Vec3& light, const PatchOfPolygon& receiver,
                         const PairFactors& scene);

}  // namespace enfilade
