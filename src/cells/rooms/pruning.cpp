#include "cells/rooms/pruning.hpp"

#include <algorithm>

namespace enfilade {
namespace {

constexpr std::uint32_t several_cells = CellId::none_value - 1;

/// By node, the one cell that all of its subtree lies in, or `several_cells`. A node's children
/// have higher numbers than the node.
std::vector<std::uint32_t> only_cells(const std::vector<BspNode>& nodes,
                                      std::span<const std::uint32_t> cell_of_leaf) {
  std::vector<std::uint32_t> only(nodes.size(), several_cells);
  for (std::size_t i = nodes.size(); i-- > 0;) {
    const BspNode& node = nodes[i];
    if (node.front < 0) {
      only[i] = cell_of_leaf[node.cell.index()];
      continue;
    }
    const std::uint32_t front = only[static_cast<std::size_t>(node.front)];
    if (front == only[static_cast<std::size_t>(node.back)]) only[i] = front;
  }
  return only;
}

/// By cell: does it have portals to two or more others? `leads_to`: the first of these.
struct Passages {
  std::vector<std::uint32_t> leads_to;
  std::vector<char> joins_two;
};

Passages passages_of(std::size_t cells, std::span<const Portal> portals) {
  Passages passages{std::vector<std::uint32_t>(cells, CellId::none_value),
                    std::vector<char>(cells, 0)};
  for (const Portal& portal : portals) {
    for (const auto& [from, to] : {std::pair{portal.a, portal.b}, std::pair{portal.b, portal.a}}) {
      std::uint32_t& first = passages.leads_to[from.index()];
      if (first == CellId::none_value) first = to.value;
      if (first != to.value) passages.joins_two[from.index()] = 1;
    }
  }
  return passages;
}

}  // namespace

std::vector<BspNode> nodes_with_cells(const BspTree& tree,
                                      std::span<const std::uint32_t> cell_of_leaf) {
  const std::vector<std::uint32_t> only = only_cells(tree.nodes, cell_of_leaf);
  struct Job {
    std::size_t from;
    std::int32_t parent;  ///< in `kept`, -1 for the root
    bool is_front;
  };
  std::vector<BspNode> kept;
  std::vector<Job> jobs{{0, -1, false}};
  while (!jobs.empty()) {
    const Job job = jobs.back();
    jobs.pop_back();
    const auto here = static_cast<std::int32_t>(kept.size());
    if (job.parent >= 0) {
      BspNode& parent = kept[static_cast<std::size_t>(job.parent)];
      (job.is_front ? parent.front : parent.back) = here;
    }
    const BspNode& node = tree.nodes[job.from];
    kept.push_back(node.front < 0 || only[job.from] == several_cells ? node : BspNode{});
    if (only[job.from] != several_cells) {
      kept.back().cell = CellId(only[job.from]);
      continue;
    }
    jobs.push_back({static_cast<std::size_t>(node.back), here, false});
    jobs.push_back({static_cast<std::size_t>(node.front), here, true});
  }
  return kept;
}

std::vector<std::uint32_t> drop_useless_cells(std::span<const Piece> pieces, const CellComplex& all,
                                              std::vector<Portal>& portals) {
  const std::size_t cells = all.cells().size();
  std::vector<char> holds_pieces(cells, 0), keep(cells, 1);
  for (const Piece& piece : pieces) {
    for (const CellPiece& part : all.cut(piece)) holds_pieces[part.cell.index()] = 1;
  }
  for (bool changed = true; changed;) {
    changed = false;
    const Passages passages = passages_of(cells, portals);
    for (std::size_t i = 0; i < cells; ++i) {
      if (!keep[i] || holds_pieces[i] || passages.joins_two[i]) continue;
      if (all.cells()[i].kind == CellKind::outside && passages.leads_to[i] != CellId::none_value)
        continue;
      keep[i] = 0;
      changed = true;
    }
    std::erase_if(portals,
                  [&](const Portal& p) { return !keep[p.a.index()] || !keep[p.b.index()]; });
  }
  std::vector<std::uint32_t> number(cells, CellId::none_value);
  std::uint32_t next = 0;
  for (std::size_t i = 0; i < cells; ++i) {
    if (keep[i]) number[i] = next++;
  }
  return number;
}

}  // namespace enfilade
