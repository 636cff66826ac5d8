// Joins neighbouring convex polygons into fewer, larger ones (Hertel & Mehlhorn 1983).
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/polygon.hpp"

namespace enfilade {

using IndexLoop = std::vector<std::uint32_t>;

/// Removes shared edges, longest first, as long as the joined loop is convex and planar within the
/// two tolerances (metres, and sine of the angle of a turn). At most four times the least possible
/// number is left.
std::vector<IndexLoop> merge_convex(const std::vector<Vec3>& points, std::vector<IndexLoop> loops,
                                    double flat_tolerance, double turn_tolerance);

}  // namespace enfilade
