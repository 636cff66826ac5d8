// Joins neighbouring convex polygons into fewer, larger ones (Hertel & Mehlhorn 1983).
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/polygon.hpp"

namespace enfilade {

using IndexLoop = std::vector<std::uint32_t>;

/// Farthest that a corner of a planar polygon may lie out of its plane, over the polygon's extent.
inline constexpr double most_bend = 6e-3;

/// Removes shared edges, longest first, as long as the joined loop is convex and planar within the
/// two tolerances (metres, but no more than most_bend times the joined loop's extent; sine of the
/// angle of a turn). At most four times the least possible number is left.
std::vector<IndexLoop> merge_convex(const std::vector<Vec3>& points, std::vector<IndexLoop> loops,
                                    double flat_tolerance, double turn_tolerance);

}  // namespace enfilade
