// The lines that join two sides through a row of windows: what a proof of hidden narrows down.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/random.hpp"
#include "geometry/half_spaces.hpp"

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
  /// `polygon` is a part of what there was.
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

/// Parts of one or several clusters, and points whose hull holds them.
struct LineSpaceSide {
  std::vector<LineSpacePart> parts;
  Box box;
  std::vector<Vec3> points;
};

LineSpaceSide side_of(std::vector<LineSpacePart> parts);

/// All lines of the lines pass it; `n` is normal to it, towards side b.
struct Window {
  Polygon polygon;
  Vec3 n{0.0};
};

/// Lines from side a through the windows, in their order, to side b.
struct LineSpace {
  LineSpaceSide a, b;
  std::vector<Window> windows;
  /// What of the lines lies beyond window i, seen from a; and before it, seen from b.
  std::vector<HalfSpaces> beyond, before;
};

/// Leaves of the sides only what has some of the other more than `flat_m` in front of it; false
/// where nothing is left.
bool drop_averted(LineSpace& lines, double flat_m);

/// Cuts windows and sides to what lines through the other windows reach, everything taken `slack_m`
/// larger than it is; false where no line is left. Fills `beyond` and `before`.
bool tighten(LineSpace& lines, double slack_m);

/// Where the lines crosses a plane, and the windows that lie on both sides of it: those from
/// `first` to before `end`. Where there are none the plane comes before window `first`.
struct LineSpaceCrossing {
  std::size_t first = 0, end = 0;
  Polygon region;
};

/// None where the plane does not part the lines in two. What lies in the plane, to `tolerance_m`,
/// is on the side that it looks to.
std::optional<LineSpaceCrossing> crossing(const LineSpace& lines, const Plane& plane,
                                          double tolerance_m);

struct SampledLine {
  const LineSpacePart* from = nullptr;
  const LineSpacePart* to = nullptr;
  Vec3 a{0.0}, b{0.0};
};

/// A random line of the lines; none where a few tries find none.
std::optional<SampledLine> draw_line(const LineSpace& lines, Random& random);
/// A random line between the sides that need not pass the windows; none where they do not see each
/// other.
std::optional<SampledLine> draw_any_line(const LineSpace& lines, Random& random);

}  // namespace enfilade
