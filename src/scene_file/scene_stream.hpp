// Writes a scene surface by surface, so that its size needs no memory.
#pragma once

#include <string>
#include <vector>

#include "base/atomic_file.hpp"
#include "scene/scene.hpp"
#include "scene_file/distribution_names.hpp"

namespace enfilade {

/// The file appears under its name when it is finished, and not before: a stream that is dropped
/// leaves nothing. Throws RunError where the file cannot be written.
class SceneStream {
 public:
  SceneStream(std::string path, ExitanceUnit unit);

  void add(const Surface& surface);
  void finish(const std::vector<LightSource>& lights, const std::vector<Probe>& probes,
              const BuildingData& building = {});

 private:
  void flush();

  AtomicFile file_;
  ExitanceUnit unit_;
  DistributionNames distributions_;
  std::string text_;  ///< not yet written
  bool any_surface_ = false;
};

}  // namespace enfilade
