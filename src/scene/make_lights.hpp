// What the solver takes for lights, made of what a scene says.
#pragma once

#include "scene/scene.hpp"

namespace enfilade {

/// Gives luminaires their openings, and puts lights in place of the exitance of surfaces whose
/// light has a distribution. Openings are lifted off along their aim by a millionth of the scene,
/// so that the ceiling or the surface that they lie in does not hide them. Once for each scene,
/// after make_pieces(), which tells what is in front by the exitance.
void make_lights(Scene& scene);

}  // namespace enfilade
