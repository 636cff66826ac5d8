// The sides of a box, for scenes that tests build in code.
#pragma once

#include <algorithm>
#include <vector>

#include "geometry/polygon.hpp"

namespace enfilade::test {

/// The six sides of a box: floor, ceiling, y = lo, y = hi, x = lo, x = hi; `inward`: their fronts
/// look into it.
inline std::vector<Polygon> box_faces(const Vec3& lo, const Vec3& hi, bool inward) {
  const auto p = [&](int x, int y, int z) {
    return Vec3(x ? hi.x : lo.x, y ? hi.y : lo.y, z ? hi.z : lo.z);
  };
  std::vector<Polygon> faces{{p(0, 0, 0), p(1, 0, 0), p(1, 1, 0), p(0, 1, 0)},
                             {p(0, 0, 1), p(0, 1, 1), p(1, 1, 1), p(1, 0, 1)},
                             {p(0, 0, 0), p(0, 0, 1), p(1, 0, 1), p(1, 0, 0)},
                             {p(0, 1, 0), p(1, 1, 0), p(1, 1, 1), p(0, 1, 1)},
                             {p(0, 0, 0), p(0, 1, 0), p(0, 1, 1), p(0, 0, 1)},
                             {p(1, 0, 0), p(1, 0, 1), p(1, 1, 1), p(1, 1, 0)}};
  // As written they look inward: the floor's vertices run counter-clockwise seen from above.
  if (!inward) {
    for (Polygon& f : faces) std::reverse(f.begin(), f.end());
  }
  return faces;
}

}  // namespace enfilade::test
