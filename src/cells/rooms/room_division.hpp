// A plane across a room: what it would cut off, without cutting yet.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "cells/rooms/leaf_cutter.hpp"

namespace enfilade {

/// A part of a plane's section through a room, with its extent along the plane's horizontal and
/// along up: through a leaf, or where two leaves touch (an interface's openings) in that plane.
struct SectionPart {
  static constexpr std::uint32_t none = 0xFFFFFFFFu;
  std::uint32_t leaf = none, interface = none;
  Polygon polygon;
  double area_m2 = 0.0;
  double u0 = 0.0, u1 = 0.0, v0 = 0.0, v1 = 0.0;
};

/// The coordinates of a standing plane.
struct StandingAxes {
  Vec3 along{0.0}, up{0.0};
};
StandingAxes standing_axes(const Vec3& n, const Vec3& up);

/// The section of a group by a plane, in the parts that hang together.
std::vector<std::vector<SectionPart>> sections(const CutSpace& space, const LeafCutter& cutter,
                                               const std::vector<std::uint32_t>& leaves,
                                               std::uint32_t plane);

/// What lies on either side of one such section.
struct Division {
  bool separates = false;  ///< there is no way round the section
  double front_m3 = 0.0, behind_m3 = 0.0;
  std::vector<std::uint32_t> front, behind;  ///< leaves that are not cut
};
Division divide(const CutSpace& space, const LeafCutter& cutter,
                const std::vector<std::uint32_t>& leaves, const Plane& plane,
                const std::vector<SectionPart>& section);

/// Cuts along the section of a group; what lies in front is a new group.
void carry_out(LeafCutter& cutter, std::uint32_t group, const Division& division,
               const std::vector<SectionPart>& section, std::uint32_t plane);

}  // namespace enfilade
