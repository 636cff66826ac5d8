// From pieces to cells: the whole of what this room and cells/partition do.
#pragma once

#include <span>
#include <vector>

#include "cells/partition/cell_complex.hpp"
#include "cells/rooms/leaks.hpp"

namespace enfilade {

/// Cuts the scene into cells, in six steps, each in its file:
/// 1. plane_set, bsp: a partition along the most occluding planes of any orientation, deeper than
/// the rooms need;
/// 2. interface, apertures: what is open between its leaves, never less than there is, and how much
/// of that is framed like a door;
/// 3. leaf_graph, leaf_merge: leaves that are open to each other become rooms, furniture and
/// leaking solids join them;
/// 4. room_kinds: what is left is a room, or the inside of a wall, a floor or a cupboard;
/// 5. portal_build: what is open between rooms becomes few convex portals;
/// 6. build_cells: cells that hold nothing and lead nowhere are left out.
/// Merging and hulls only ever add to what is taken as visible, so every threshold is safe. One
/// room, or a scene without walls, is one cell.
CellComplex build_cells(std::span<const Piece> pieces, const CellComplex::Config& config);
/// build_cells, and the leaks of its cells: the worst of a kind for each, in the order of their
/// numbers.
CellComplex build_cells(std::span<const Piece> pieces, const CellComplex::Config& config,
                        std::vector<Leak>& leaks);

}  // namespace enfilade
