// A hint at surfaces that were wound the wrong way.
#pragma once

#include <vector>

#include "scene/scene_scale.hpp"

namespace enfilade {

/// Surfaces that face the other way than the rest of a shell of their object: two neighbours with
/// the same facing run along their shared edge in opposite directions. Silent where a shell has no
/// consistent facing, or no clear majority; edges of three and more surfaces and two-sided surfaces
/// say nothing.
std::vector<SurfaceId> reversed_surfaces(const Scene& scene, const SceneScale& scale);

}  // namespace enfilade
