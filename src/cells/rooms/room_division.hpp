// A plane across a room: the parts that it would leave on either side, without cutting yet.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "cells/rooms/leaf_cutter.hpp"

namespace enfilade {

/// A part of a plane's section through a room: through a leaf, or where two leaves touch (an
/// interface's openings) in that plane. u and v are its extents along the plane's horizontal and
/// along up, m.
struct SectionPart {
  static constexpr std::uint32_t none = 0xFFFFFFFFu;
  std::uint32_t leaf = none, interface = none;
  Polygon polygon;
  double area_m2 = 0.0;
  double u0 = 0.0, u1 = 0.0, v0 = 0.0, v1 = 0.0;
};

/// The axes of an upright plane: its horizontal, and up.
struct StandingAxes {
  Vec3 along{0.0}, up{0.0};
};
StandingAxes standing_axes(const Vec3& n, const Vec3& up);

/// Returns the section of a group's leaves by plane number `plane`, in its connected components.
std::vector<std::vector<SectionPart>> sections(const CutSpace& space, const LeafCutter& cutter,
                                               const std::vector<std::uint32_t>& leaves,
                                               std::uint32_t plane);

/// The leaves on either side of one connected section, and their volumes.
struct Division {
  bool separates = false;  ///< no way leads round the section; if false, the rest is not filled in
  double front_m3 = 0.0, behind_m3 = 0.0;
  std::vector<std::uint32_t> front, behind;  ///< leaves that are not cut
};
Division divide(const CutSpace& space, const LeafCutter& cutter,
                const std::vector<std::uint32_t>& leaves, const Plane& plane,
                const std::vector<SectionPart>& section);

/// Cuts a group along the section; the part in front becomes a new group.
void carry_out(LeafCutter& cutter, std::uint32_t group, const Division& division,
               const std::vector<SectionPart>& section, std::uint32_t plane);

}  // namespace enfilade
