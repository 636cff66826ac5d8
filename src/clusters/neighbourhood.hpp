// Connected polygons, and polygons that lie close: clusters where the file names no objects (§3.2).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "geometry/polygon.hpp"

namespace enfilade {

/// Indices into a list of polygons.
using Group = std::vector<std::size_t>;

/// Returns the connected components of the polygons that share vertices (to `tolerance_m`), each in
/// ascending order, ordered by first member.
std::vector<Group> connected_groups(std::span<const Polygon* const> polygons, double tolerance_m);

/// Halves a group by position along its longest axis until no part has more than `max_size`
/// polygons or, where `max_extent_m` > 0, a longer side than that (a polygon that is longer stays
/// whole, by itself).
std::vector<Group> split_by_position(std::span<const Polygon* const> polygons, Group group,
                                     std::size_t max_size, double max_extent_m);

}  // namespace enfilade
