// Solids of glass: light passes a thin one as it passes one pane.
#pragma once

#include <vector>

#include "scene/scene.hpp"

namespace enfilade {

/// The surfaces from number `first` on are the faces of a solid of glass, or of several, that look
/// outward; their transmittance is that of the whole solid. Of each two parallel sides of a thin
/// part one is kept, which then dims by the angle as one pane does, and the faces around their edge
/// are left out. Light passes two faces of anything else: each of them gets the root.
void merge_pane_bodies(std::vector<Surface>& surfaces, std::size_t first);

}  // namespace enfilade
