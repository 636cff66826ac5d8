// From pieces to cells: all steps of cells/partition, cells/merging and cells/rooms.
#pragma once

#include <span>
#include <vector>

#include "cells/partition/cell_complex.hpp"
#include "cells/rooms/leaks.hpp"

namespace enfilade {

/// Cuts the scene into cells, in seven steps, each in its files:
/// 1. plane_set, bsp: a partition along the most occluding planes of any orientation, deeper than
/// the rooms need;
/// 2. interface, apertures: the openings between its leaves, never smaller than they are, and how
/// much of them is framed like a door; leaves that lie across a door are cut, and the openings
/// found anew;
/// 3. leaf_graph, merge_candidates, leaf_merge: leaves that are open to each other become rooms,
/// furniture and leaking solids join them;
/// 4. room_kinds: each group left is a room, or the inside of a wall, a floor or a cupboard;
/// 5. floor_steps, stairwells: rooms that no wall parts are cut again;
/// 6. portal_build: the openings between rooms become few convex portals;
/// 7. pruning: cells that hold nothing and lead nowhere are left out.
/// Merging and hulls only ever add to the pairs that are taken to see each other, so every
/// threshold is safe. One room, or a scene without walls, is one cell.
CellComplex build_cells(std::span<const Piece> pieces, const CellComplex::Config& config);
/// Builds the cells, and finds their leaks: for each cell the largest of each kind, in the order of
/// the cells' numbers.
CellComplex build_cells(std::span<const Piece> pieces, const CellComplex::Config& config,
                        std::vector<Leak>& leaks);

}  // namespace enfilade
