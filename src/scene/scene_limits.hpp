// The gate that every scene passes, wherever it comes from: files of ours, importers, generators.
#pragma once

#include <string>

#include "scene/scene.hpp"

namespace enfilade {

/// Throws InputError where a number of the scene is outside the limits (base/limits.hpp): places,
/// the scene's extent, light, bands, normals of probes.
void check_limits(const Scene& scene);

/// Returns how messages name a surface: surfaces[3] "wall north".
std::string label(const Scene& scene, SurfaceId id);

}  // namespace enfilade
