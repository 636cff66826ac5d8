// The parts of a polygon that a point sees past occluders, exact: convex parts, cut by one occluder
// at a time.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/polygon.hpp"

namespace enfilade {

/// Starts with a whole convex polygon and takes away the parts that convex occluders hide from x
/// (Nishita and Nakamae 1985). The corners of all parts lie in one array, so that an object that is
/// used again allocates nothing.
class VisibleParts {
 public:
  /// Corners within `tolerance_m` of a plane count as on it.
  void begin(const Vec3& x, std::span<const Vec3> polygon, double tolerance_m);
  /// Cuts away the shadow of an occluder; an occluder seen edge-on has none. Returns false where
  /// more than `most` parts are left.
  bool hide(std::span<const Vec3> occluder, std::size_t most = 48);

  bool empty() const { return ends_.empty(); }
  std::size_t size() const { return ends_.size(); }
  std::span<const Vec3> operator[](std::size_t i) const {
    const std::size_t begin = i == 0 ? 0 : ends_[i - 1];
    return {corners_.data() + begin, ends_[i] - begin};
  }
  /// Returns the form factor of all parts from x with unit normal n.
  double factor(const Vec3& n) const;

 private:
  void cut(std::span<const Vec3> part);

  Vec3 x_{0.0};
  double tolerance_m_ = 0.0;
  std::vector<Vec3> corners_, next_corners_;
  std::vector<std::uint32_t> ends_, next_ends_;
  std::vector<Plane> planes_;  ///< of the occluder's shadow; inside is in front of all
  std::vector<Vec3> inside_, still_inside_;
};

}  // namespace enfilade
