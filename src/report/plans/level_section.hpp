// What a level cut meets: cells as areas, polygons as lines.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "cells/partition/cell_complex.hpp"

namespace enfilade {

/// Where one cell meets the cut.
struct CellSection {
  CellId cell;                 ///< none: where no cell was kept (the insides of walls)
  std::vector<Polygon> parts;  ///< convex and disjoint, counter-clockwise seen from above
  double area_m2 = 0.0;
};

/// Returns the plane at height z_m, over the box's ground, cut by the cells' partition: exact, and
/// together all of it. By cell; where no cell was kept comes last.
std::vector<CellSection> level_section(const CellComplex& complex, const Box& box, double z_m);

/// Where a convex polygon that is not level crosses height z_m.
std::optional<std::pair<Vec3, Vec3>> level_cut(const Polygon& polygon, double z_m);

}  // namespace enfilade
