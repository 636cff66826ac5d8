// What shines together: the luminaires and emitting surfaces whose share of the light is asked for
// as one.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/ids.hpp"
#include "scene/scene.hpp"

namespace enfilade {

/// The lights and surfaces of one switch. Each that emits is of exactly one group.
struct ShareGroup {
  std::string name;
  std::vector<std::size_t> lights;  ///< index in Scene::lights
  std::vector<SurfaceId> surfaces;
};

/// Returns the groups of a scene: by "switch" where that is given; else lights and luminaires by
/// name, surfaces by object or, without one, by name. Without any of these each is a group of its
/// own, "light 3" or "surface 12", as the scene file numbers them. Lights come first. Throws
/// InputError where nothing emits.
std::vector<ShareGroup> share_groups(const Scene& scene);

/// Returns the number of the group of this name. Throws InputError that lists the names, where
/// there is none; `option` is where the name stands.
std::size_t find_group(const std::vector<std::string>& names, const std::string& name,
                       const std::string& option);

}  // namespace enfilade
