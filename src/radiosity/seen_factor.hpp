// How much of a polygon a point sees past what few others hide, in closed form.
#pragma once

#include <optional>

#include "radiosity/occluders.hpp"

namespace enfilade {

/// Form factor from p (unit normal n, on polygon `own` or on none) of polygon `seen` (global
/// numbers) with these corners, less what up to 16 others hide of it; none where more stand
/// between.
std::optional<double> seen_factor(const Occluders& occluders, const Vec3& p, const Vec3& n,
                                  std::uint32_t own, std::uint32_t seen, const Polygon& corners);

}  // namespace enfilade
