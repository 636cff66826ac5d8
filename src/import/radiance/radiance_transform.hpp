// Affine maps that keep angles, as Radiance's xform makes them.
#pragma once

#include "geometry/polygon.hpp"

namespace enfilade {

/// p -> linear p + shift; linear turns, mirrors and scales alike along all axes.
struct RadianceTransform {
  glm::dmat3 linear{1.0};
  Vec3 shift{0.0};

  /// This one first, then `next`.
  RadianceTransform then(const RadianceTransform& next) const {
    return {next.linear * linear, next.linear * shift + next.shift};
  }
  /// Returns the image of a polygon, its front still its front: a mirror turns its winding around.
  Polygon image_of(Polygon polygon) const {
    for (Vec3& p : polygon) p = linear * p + shift;
    if (glm::determinant(linear) < 0.0) std::reverse(polygon.begin(), polygon.end());
    return polygon;
  }
};

}  // namespace enfilade
