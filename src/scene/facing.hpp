// Finds surfaces whose corners seem to run the wrong way round.
#pragma once

#include <vector>

#include "scene/scene_scale.hpp"

namespace enfilade {

/// Surfaces that face the other way than the rest of a shell of their object: two neighbours with
/// the same facing run along their shared edge in opposite directions. None of a shell without
/// consistent facing, or without a clear majority; edges of three and more surfaces and two-sided
/// surfaces say nothing.
std::vector<SurfaceId> reversed_surfaces(const Scene& scene, const SceneScale& scale);

}  // namespace enfilade
