// Where the light of a polygon's visible parts comes from.
#pragma once

#include <span>

#include "geometry/form_factor.hpp"
#include "hierarchy/patch_forest.hpp"

namespace enfilade {

/// The centroid of the parts' light in their polygon's frame, as x with normal n weighs it: three
/// points a triangle, exact for quadratics (Strang and Fix 1973).
struct MeanPlace {
  const Vec3 &x, &n;
  const PolygonFrame& frame;
  Vec2 sum{0.0};
  double weight = 0.0;

  void add(std::span<const Vec3> part, double passing) {
    for (std::size_t i = 2; i < part.size(); ++i) {
      const Vec3 corner[3] = {part[0], part[i - 1], part[i]};
      const double area = glm::length(glm::cross(corner[1] - corner[0], corner[2] - corner[0]));
      for (int side = 0; side < 3; ++side) {
        const Vec3 y = 0.5 * (corner[side] + corner[(side + 1) % 3]);
        const double w = passing * area * point_kernel(x, n, y, frame.n);
        weight += w;
        sum += w * frame.project(y);
      }
    }
  }
  Vec2 mean() const { return weight > 0.0 ? sum / weight : Vec2(0.0); }
};

}  // namespace enfilade
