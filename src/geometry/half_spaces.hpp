// Half spaces that hold all that can be seen through windows: of Teller's anti-penumbra (1992) the
// planes through an edge of the window and a vertex of the source.
#pragma once

#include <span>
#include <vector>

#include "geometry/convex.hpp"

namespace enfilade {

/// Points with n.p >= d for every plane.
using HalfSpaces = std::vector<Plane>;

/// Adds, for every edge of `window`, the half space that lines from `source` through the window
/// stay in beyond it: its plane passes through the edge and touches the source, and has the source
/// on its other side. `n` is the window's unit normal towards where it leads; the source lies on
/// this side of it. Source and window count as `slack_m` larger than they are, so that no line is
/// lost to rounding.
void add_penumbra(std::span<const Vec3> source, const Polygon& window, const Vec3& n,
                  double slack_m, HalfSpaces& out);

/// True where all of the polygon (or box) lies outside of one of the half spaces by more than
/// `slack_m`.
bool outside(const Polygon& polygon, const HalfSpaces& spaces, double slack_m);
bool outside(const Box& box, const HalfSpaces& spaces, double slack_m);

/// Returns the part of the polygon inside all half spaces enlarged by `slack_m`; empty where there
/// is none.
Polygon clip_to(Polygon polygon, const HalfSpaces& spaces, double slack_m);

}  // namespace enfilade
