// One end of a line space: polygons, or parts of polygons, that its lines start or end at.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/convex.hpp"

namespace enfilade {

/// A polygon, or what is left of it, that lines start or end at.
class LineSpacePart {
 public:
  static constexpr std::uint32_t no_number = 0xFFFFFFFFu;  ///< of what is no polygon of the scene

  /// Keeps a pointer to the polygon.
  LineSpacePart(std::uint32_t number, const Polygon& whole, const Plane& plane)
      : number_(number), whole_(&whole), plane_(plane) {}

  std::uint32_t number() const { return number_; }
  const Polygon& polygon() const { return cut_.empty() ? *whole_ : cut_; }
  const Plane& plane() const { return plane_; }
  /// Returns this part, cut to `polygon`, which lies within the part's polygon.
  LineSpacePart cut_to(Polygon polygon) const {
    LineSpacePart part(*this);
    part.cut_ = std::move(polygon);
    return part;
  }

 private:
  std::uint32_t number_;
  const Polygon* whole_;
  Plane plane_;
  Polygon cut_;
};

/// Parts of one or several clusters, and points whose hull holds them all: the parts' vertices, or
/// the corners of a box where these are many.
struct LineSpaceSide {
  std::vector<LineSpacePart> parts;
  Box box;
  std::vector<Vec3> points;
};

LineSpaceSide side_of(std::vector<LineSpacePart> parts);

}  // namespace enfilade
