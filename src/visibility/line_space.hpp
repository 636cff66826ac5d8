// The line space of a portal sequence: all lines that join two sides through a row of windows. A
// proof that one side is hidden from the other cuts it down until no line is left (§3.2; the
// windows' penumbrae are those of Teller 1992).
#pragma once

#include <optional>
#include <vector>

#include "geometry/half_spaces.hpp"
#include "visibility/line_space_side.hpp"

namespace enfilade {

/// A convex opening that all lines of a line space pass; `n` is its unit normal towards side b.
struct Window {
  Polygon polygon;
  Vec3 n{0.0};
};

/// Lines from side a through the windows, in their order, to side b.
struct LineSpace {
  LineSpaceSide a, b;
  std::vector<Window> windows;
  /// By window: where the lines lie beyond it, from side a; and before it, from side b.
  std::vector<HalfSpaces> beyond, before;
};

/// Drops the parts of each side that have nothing of the other side more than `flat_m` in front of
/// them; false where a side has no part left.
bool drop_averted(LineSpace& lines, double flat_m);

/// Cuts windows and sides to what lines through the other windows reach, every limit moved outwards
/// by `slack_m`; false where no line is left. Fills `beyond` and `before`.
bool tighten(LineSpace& lines, double slack_m);

/// Where a line space crosses a plane, and the windows that lie on both sides of the plane: those
/// from `first` to before `end`. Where `first` equals `end` the plane comes before that window.
struct LineSpaceCrossing {
  std::size_t first = 0, end = 0;
  Polygon region;
};

/// Returns the convex hull of the points in which lines of the line space cross the plane; none
/// where the plane does not part the two sides. A part that lies in the plane, to `tolerance_m`, is
/// on the side that it faces.
std::optional<LineSpaceCrossing> crossing(const LineSpace& lines, const Plane& plane,
                                          double tolerance_m);

}  // namespace enfilade
