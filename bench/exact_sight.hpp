// Is anything between two points? In double precision and without an epsilon at the ends, where a
// ray tracer is blind: the monitor of what it takes for open.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "geometry/box_tree.hpp"
#include "geometry/polygon.hpp"

namespace enfilade::bench {

class ExactSight {
 public:
  explicit ExactSight(std::span<const Polygon> polygons);

  /// Do all polygons but the two on which the points lie leave the segment free? A point in the
  /// plane of a polygon, to rounding, is not behind it.
  bool open(const Vec3& a, const Vec3& b, std::uint32_t of_a, std::uint32_t of_b) const;

  /// Ends this close to the other's plane lie in it: files give coordinates to so much, and
  /// polygons of one wall exchange no light along it.
  double flat_m() const { return flat_m_; }

 private:
  /// What is not flat blocks as a fan of triangles.
  struct Part {
    Polygon polygon;
    Plane plane;
    std::uint32_t of;
  };
  bool blocks(const Part& part, const Vec3& a, const Vec3& b) const;

  std::vector<Part> parts_;
  std::unique_ptr<BoxTree> tree_;
  double rounding_m_ = 0.0, flat_m_ = 0.0;
};

}  // namespace enfilade::bench
