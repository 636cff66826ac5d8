// Tolerances that grow and shrink with the scene, so that a scene in millimetres is treated like
// one in kilometres.
#pragma once

#include <algorithm>

#include "geometry/convex_merge.hpp"
#include "scene/scene.hpp"

namespace enfilade {

/// How large a scene is, and how far from the origin; every tolerance of this room follows from
/// these.
class SceneScale {
 public:
  explicit SceneScale(const Scene& scene) {
    for (const Surface& surface : scene.surfaces) box_.add(bounds(surface.vertices));
    if (box_.empty()) return;
    diagonal_ = box_.diagonal();
    // 16 times the spacing of doubles at the farthest coordinate.
    noise_ = 16.0 * 2.2e-16 * std::max(glm::length(box_.lo), glm::length(box_.hi));
  }

  const Box& box() const { return box_; }
  /// Vertices of a polygon of this extent that are closer than this count as one.
  double same_vertex(double extent) const { return std::max(1e-9 * extent, noise_); }
  /// Farthest that a vertex of a planar, convex polygon may lie out of its plane or inside its
  /// hull. Models of buildings are rounded to 0.1 mm or 1 mm; a small part may not hide a real bend
  /// in that.
  double flat(double extent) const {
    return std::max(std::min(5e-5 * diagonal_, most_bend * extent), noise_);
  }
  /// Thinner polygons are slivers: they reflect nothing that counts and have no dependable normal.
  double sliver(double extent) const { return std::max({1e-6 * extent, 1e-7 * diagonal_, noise_}); }
  /// Planes farther apart than this are two planes. Far below any real gap (f. e. 1 mm between two
  /// sheets).
  double coplanar() const { return std::max(1e-5 * diagonal_, noise_); }
  /// Where covered parts are cut away, edges closer than this are one edge.
  double cut() const { return std::max(1e-6 * diagonal_, noise_); }

 private:
  Box box_;
  double diagonal_ = 0.0, noise_ = 0.0;
};

}  // namespace enfilade
