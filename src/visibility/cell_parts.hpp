// Where a cluster's polygons really lie. Cutting leaves what sticks out of a cell by less than the
// tolerance whole, and what lies in a border within the tolerance goes to the side that it faces:
// right for the light, but the part that sticks out sees the neighbouring cell, and that pair must
// not be missed.
#pragma once

#include <vector>

#include "cells/partition/cell_complex.hpp"
#include "clusters/cluster.hpp"
#include "visibility/portal_search.hpp"

namespace enfilade {

/// The polygons, or parts of them, that a cluster has in one cell.
struct CellPart {
  CellId cell;
  std::vector<SourcePolygon> polygons;
  Box box;
};

/// The cluster's own cell first, with all its polygons whole; then the cells that it sticks out
/// into. Its first polygon has this number among those of all clusters.
std::vector<CellPart> parts_by_cell(const CellComplex& complex, const Cluster& cluster,
                                    std::uint32_t first_number);

}  // namespace enfilade
