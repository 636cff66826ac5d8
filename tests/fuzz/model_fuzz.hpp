// What the fuzz targets of importers share: an importer's scene goes the way that it goes from the
// importer's own process.
#pragma once

#include <cmath>
#include <functional>

#include "base/error.hpp"
#include "base/warnings.hpp"
#include "fuzz_target.hpp"
#include "import/intake/scene_bytes.hpp"
#include "scene/scene_limits.hpp"

namespace enfilade::fuzz {

inline void check_model(const std::function<Scene(Warnings&)>& import) {
  Warnings warnings;
  try {
    const Scene imported = import(warnings);
    check_limits(imported);
    const Scene scene = scene_from(bytes_of(imported, warnings), warnings);
    require(scene.surfaces.size() == imported.surfaces.size());
    for (const Surface& surface : scene.surfaces) {
      require(surface.vertices.size() >= 3);
      for (const double r : surface.reflectance) require(r >= 0.0 && r < 1.0);
      for (const double e : surface.exitance) require(e >= 0.0 && std::isfinite(e));
    }
  } catch (const InputError&) {
  } catch (const std::bad_alloc&) {  // in its own process, an importer's memory has an end
  }
}

}  // namespace enfilade::fuzz
