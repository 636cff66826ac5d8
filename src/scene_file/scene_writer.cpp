// Writes scenes so that a reader never meets half of one.
#include "scene_file/scene_io.hpp"
#include "scene_file/scene_stream.hpp"

namespace enfilade {

void write_scene(const Scene& scene, const std::string& path) {
  SceneStream stream(path, scene.unit);
  for (const Surface& surface : scene.surfaces) stream.add(surface);
  stream.finish(scene.lights, scene.probes, scene.building);
}

}  // namespace enfilade
