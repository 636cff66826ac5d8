// The cells that a cluster's polygons lie in, without tolerance. Clusters are made with one: a
// polygon that sticks out of its cell by less stays whole, and one that lies in a border within it
// belongs to the side that it faces. The part that sticks out sees the neighbouring cell, and no
// visible pair may be missed.
#pragma once

#include <vector>

#include "cells/partition/cell_complex.hpp"
#include "clusters/cluster.hpp"
#include "visibility/portal_search.hpp"

namespace enfilade {

/// The polygons of a cluster, or parts of them, that lie in one cell.
struct CellPart {
  CellId cell;
  std::vector<SourcePolygon> polygons;
  Box box;
};

/// Returns the cluster's own cell first, with all its polygons whole; then the cells that it sticks
/// out into. `first_number`: number of the cluster's first polygon among the polygons of all
/// clusters.
std::vector<CellPart> parts_by_cell(const CellComplex& complex, const Cluster& cluster,
                                    std::uint32_t first_number);

}  // namespace enfilade
