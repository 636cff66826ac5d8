// What a dome of the sky brings to a point, with what hides it and the panes before it.
#pragma once

#include "occluders/light_at.hpp"

namespace enfilade {

/// Exact visible parts of each facet, and of each part the form factor in closed form times its
/// mean luminance by quadrature. Facets behind many polygons are halved until few stand before
/// each; what is too small for that is taken by one ray, and is part of the error. Counts rays in
/// `work` unless that is null.
LightAtPoint sky_at(const LightSource& light, const LitPlace& place, const Occluders& occluders,
                    WorkCount* work);

}  // namespace enfilade
