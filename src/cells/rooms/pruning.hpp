// What cells do not need: cells that hold nothing and lead nowhere, planes that part one cell.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cells/partition/bsp.hpp"
#include "cells/partition/cell_complex.hpp"

namespace enfilade {

/// Returns the nodes of the tree with cells in place of leaves: cell_of_leaf[leaf],
/// CellId::none_value for none. Subtrees that lie in one cell become leaves. Root first, a node's
/// front subtree before its back subtree.
std::vector<BspNode> nodes_with_cells(const BspTree& tree,
                                      std::span<const std::uint32_t> cell_of_leaf);

/// Drops cells that hold no piece and join no two others, with their portals. The outside stays
/// where two openings of one room may see each other through it. Returns the new number of each
/// cell of `all`, CellId::none_value for one that is dropped; `portals` keep their old numbers.
std::vector<std::uint32_t> drop_useless_cells(std::span<const Piece> pieces, const CellComplex& all,
                                              std::vector<Portal>& portals);

}  // namespace enfilade
