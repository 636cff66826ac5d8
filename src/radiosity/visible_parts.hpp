// What a point sees of a polygon past others, exactly: each one's shadow is cut out of it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "radiosity/occluders.hpp"

namespace enfilade {

/// The parts of `target` (convex; x in front of it) that x sees past `blockers`, numbers as of
/// Occluders::between: convex, disjoint, wound as `target`; none where all of it is hidden. A
/// blocker that x sees edge-on hides nothing.
std::vector<Polygon> visible_parts(const Vec3& x, const Polygon& target,
                                   std::span<const std::uint32_t> blockers,
                                   const Occluders& occluders);

}  // namespace enfilade
