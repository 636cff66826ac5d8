// A surface that the tests of links are made of.
#pragma once

#include <algorithm>

#include "scene/scene.hpp"

namespace enfilade::testing {

/// A horizontal rectangle, facing up or down.
inline Surface sheet(Vec2 lo, Vec2 hi, double z, bool up) {
  Surface s;
  s.vertices = {{lo.x, lo.y, z}, {hi.x, lo.y, z}, {hi.x, hi.y, z}, {lo.x, hi.y, z}};
  if (!up) std::reverse(s.vertices.begin(), s.vertices.end());
  s.reflectance = {0.5};
  s.exitance = {1.0};
  return s;
}

}  // namespace enfilade::testing
