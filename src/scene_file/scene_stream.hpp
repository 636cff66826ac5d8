// Writes a scene surface by surface, so that its size needs no memory.
#pragma once

#include <cstdio>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace enfilade {

/// The file appears under its name when it is finished, and not before: a stream that is dropped
/// leaves nothing. Throws RunError where the file cannot be written.
class SceneStream {
 public:
  SceneStream(std::string path, ExitanceUnit unit);
  ~SceneStream();
  SceneStream(const SceneStream&) = delete;
  SceneStream& operator=(const SceneStream&) = delete;

  void add(const Surface& surface);
  void finish(const std::vector<PointLight>& lights, const std::vector<Probe>& probes,
              const BuildingData& building = {});

 private:
  void flush();
  [[noreturn]] void fail();

  std::string path_, temporary_;
  std::FILE* file_ = nullptr;
  std::string text_;  ///< not yet written
  bool any_surface_ = false;
};

}  // namespace enfilade
