// The outline of a floor that comes as triangles.
#pragma once

#include <vector>

#include "base/geometry.hpp"

namespace enfilade {

/// Returns the outer ring of the largest connected part, counter-clockwise, without points on
/// straight lines; `corners` are three a triangle, in any order. Empty where they have no area.
std::vector<Vec2> floor_outline(const std::vector<Vec2>& corners);

}  // namespace enfilade
