// From pieces to cells: planes, partition, interfaces, merging, portals; and what is of no use left
// out.
#include <algorithm>
#include <cmath>

#include "cells/partition/apertures.hpp"
#include "cells/partition/bsp.hpp"
#include "cells/partition/cell_complex.hpp"
#include "cells/partition/interface.hpp"
#include "cells/partition/leaf_merge.hpp"
#include "cells/partition/plane_set.hpp"
#include "cells/partition/portal_build.hpp"
#include "cells/rooms/build_cells.hpp"
#include "cells/rooms/floor_steps.hpp"
#include "cells/rooms/leaks.hpp"
#include "cells/rooms/stairwells.hpp"

namespace enfilade {
namespace {

constexpr std::uint32_t no_cell = CellId::none_value;

// Leaves whose region has a face on the border of the enlarged box.
std::vector<char> find_touching(const std::vector<Region>& leaves, const Region& box) {
  std::vector<char> touching;
  for (const Region& leaf : leaves) {
    touching.push_back(largest_on_border(leaf, box) != nullptr ? 1 : 0);
  }
  return touching;
}

Region clip_to(Region region, const Region& box) {
  for (const Facet& side : box.facets) {
    region = split_region(region, side.plane, cross_section(region, side.plane)).second;
  }
  return region;
}

// Subtrees that lie in one cell become leaves; only what is left is kept, root first.
std::int32_t copy_pruned(const std::vector<BspNode>& from, std::int32_t at,
                         std::vector<BspNode>& to) {
  const BspNode& node = from[static_cast<std::size_t>(at)];
  const auto here = static_cast<std::int32_t>(to.size());
  to.push_back(node);
  if (node.front < 0) return here;
  const std::int32_t front = copy_pruned(from, node.front, to);
  const std::int32_t back = copy_pruned(from, node.back, to);
  const auto cell_of = [&](std::int32_t i) {
    const BspNode& n = to[static_cast<std::size_t>(i)];
    return n.front < 0 ? n.cell.value : no_cell - 1;
  };
  BspNode& copy = to[static_cast<std::size_t>(here)];
  if (cell_of(front) != no_cell - 1 && cell_of(front) == cell_of(back)) {
    copy = BspNode{};
    copy.cell = CellId(cell_of(front));
    to.resize(static_cast<std::size_t>(here) + 1);
    return here;
  }
  copy.front = front;
  copy.back = back;
  return here;
}

std::vector<BspNode> with_cells(const BspTree& tree,
                                const std::vector<std::uint32_t>& cell_of_leaf) {
  std::vector<BspNode> nodes = tree.nodes;
  for (BspNode& node : nodes) {
    if (node.front < 0) node.cell = CellId(cell_of_leaf[node.cell.index()]);
  }
  std::vector<BspNode> pruned;
  copy_pruned(nodes, 0, pruned);
  return pruned;
}

// Cells that hold nothing and lead nowhere are dropped, with their portals; returns old -> new
// numbers.
std::vector<std::uint32_t> drop_useless(std::span<const Piece> pieces, const CellComplex& all,
                                        std::vector<Portal>& portals) {
  std::vector<char> keep(all.cells().size(), 0);
  for (const Piece& piece : pieces) {
    for (const CellPiece& part : all.cut(piece)) keep[part.cell.index()] = 1;
  }
  const auto useful = keep;
  std::fill(keep.begin(), keep.end(), 1);
  for (bool changed = true; changed;) {
    changed = false;
    std::vector<std::uint32_t> leads_to(keep.size(), no_cell);
    std::vector<char> passage(keep.size(), 0);
    for (const Portal& portal : portals) {
      for (const auto& [from, to] :
           {std::pair{portal.a, portal.b}, std::pair{portal.b, portal.a}}) {
        std::uint32_t& first = leads_to[from.index()];
        if (first == no_cell) first = to.value;
        if (first != to.value) passage[from.index()] = 1;
      }
    }
    for (std::size_t i = 0; i < keep.size(); ++i) {
      if (!keep[i] || useful[i] || passage[i]) continue;
      // The outside stays where two openings of one room can see each other through it.
      if (all.cells()[i].kind == CellKind::outside && leads_to[i] != no_cell) continue;
      keep[i] = 0;
      changed = true;
    }
    std::erase_if(portals,
                  [&](const Portal& p) { return !keep[p.a.index()] || !keep[p.b.index()]; });
  }
  std::vector<std::uint32_t> number(keep.size(), no_cell);
  std::uint32_t next = 0;
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (keep[i]) number[i] = next++;
  }
  return number;
}

/// A building in its own frame and about its own middle: cells do not depend on where it stands.
class OwnFrame {
 public:
  OwnFrame(std::span<const Piece> pieces, const Vec3& middle)
      : axes_(dominant_frame(pieces)), middle_(middle) {}

  Vec3 in(const Vec3& p) const {
    const Vec3 q = p - middle_;
    return {glm::dot(axes_[0], q), glm::dot(axes_[1], q), glm::dot(axes_[2], q)};
  }
  Vec3 direction_out(const Vec3& q) const {
    return q.x * axes_[0] + q.y * axes_[1] + q.z * axes_[2];
  }
  Vec3 out(const Vec3& q) const { return middle_ + direction_out(q); }
  std::vector<Piece> in(std::span<const Piece> pieces) const {
    std::vector<Piece> moved(pieces.begin(), pieces.end());
    for (Piece& piece : moved) {
      for (Vec3& p : piece.polygon) p = in(p);
    }
    return moved;
  }
  std::vector<BspNode> out(std::vector<BspNode> nodes) const {
    for (BspNode& node : nodes) {
      const Vec3 n = direction_out(node.plane.n);
      node.plane = {n, node.plane.d + glm::dot(n, middle_)};
    }
    return nodes;
  }
  std::vector<Portal> out(std::vector<Portal> portals) const {
    for (Portal& portal : portals) {
      for (Vec3& p : portal.polygon) p = out(p);
    }
    return portals;
  }

 private:
  Frame axes_;
  Vec3 middle_;
};

CellComplex one_cell(const Box& box, double tolerance_m) {
  const Vec3 e = box.extent();
  std::vector<BspNode> nodes(1);
  nodes[0].cell = CellId(0);
  return {{{CellId(0), CellKind::room, box, e.x * e.y * e.z}}, {}, std::move(nodes), tolerance_m};
}

std::vector<Cell> describe_cells(const std::vector<Region>& leaves, const LeafGroups& groups,
                                 const std::vector<char>& touches, const Region& inner_box,
                                 const OwnFrame& own) {
  std::vector<Cell> cells;
  for (std::size_t i = 0; i < groups.kinds.size(); ++i) {
    cells.push_back({CellId(i), groups.kinds[i], Box{}, 0.0});
  }
  for (std::size_t leaf = 0; leaf < leaves.size(); ++leaf) {
    const Region region = touches[leaf] ? clip_to(leaves[leaf], inner_box) : leaves[leaf];
    Cell& cell = cells[groups.group_of_leaf[leaf]];
    for (const Facet& facet : region.facets) {
      for (const Vec3& p : facet.polygon) cell.bounds.add(own.out(p));
    }
    cell.volume_m3 += volume_m3(region);
  }
  return cells;
}

CellComplex build(std::span<const Piece> given, const CellComplex::Config& config,
                  std::vector<Leak>* leaks) {
  Box box;
  for (const Piece& piece : given) box.add(bounds(piece.polygon));
  if (given.empty() || box.diagonal() <= 0.0) return one_cell(box, 0.0);

  const OwnFrame own(given, box.center());
  const std::vector<Piece> pieces = own.in(given);
  std::vector<Vec3> points;
  Box own_box;
  for (const Piece& piece : pieces) {
    points.insert(points.end(), piece.polygon.begin(), piece.polygon.end());
    own_box.add(bounds(piece.polygon));
  }
  const Frame axes{Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  const double diagonal = own_box.diagonal();
  const double tolerance_m = std::min(config.tolerance_relative * diagonal, 2e-3);
  PlaneSet planes = find_planes(pieces, tolerance_m);
  const Region inner_box = box_region(points, axes, 0.0);
  const Region outer_box = box_region(points, axes, 1e-3 * diagonal);
  BspTree tree = build_bsp(pieces, planes, outer_box, config, tolerance_m);
  const double sliver_m = 0.01 * tolerance_m;
  std::vector<LeafInterface> interfaces = find_interfaces(tree, sliver_m);
  frame_apertures(interfaces, tree, tolerance_m);

  std::vector<double> volumes;
  for (const Region& leaf : tree.leaves) volumes.push_back(volume_m3(leaf));
  LeafGroups groups =
      merge_leaves(volumes, find_touching(tree.leaves, outer_box), interfaces, MergeConfig{});
  CutSpace space{pieces, planes, tree, interfaces, groups, axes[0], tolerance_m};
  LeafCutter cutter(space);
  cut_at_steps(space, cutter, StepConfig{});
  cut_stairwells(space, cutter, StairwellConfig{});
  const std::vector<char> touches = find_touching(tree.leaves, outer_box);
  std::vector<Cell> cells = describe_cells(tree.leaves, groups, touches, inner_box, own);
  std::vector<Portal> portals =
      build_portals(interfaces, groups.group_of_leaf, planes.planes, tolerance_m);

  std::vector<Leak> found;
  if (leaks != nullptr) found = find_leaks(space, cutter, portals, outer_box, touches, groups.lost);
  const CellComplex all(cells, portals, with_cells(tree, groups.group_of_leaf), tolerance_m);
  const std::vector<std::uint32_t> number = drop_useless(pieces, all, portals);
  std::vector<Cell> kept;
  for (const Cell& cell : cells) {
    if (number[cell.id.index()] == no_cell) continue;
    kept.push_back(cell);
    kept.back().id = CellId(kept.size() - 1);
  }
  // Nothing encloses anything: the scene is one room, wherever a point lies.
  const bool is_one_room = kept.size() == 1 && kept[0].kind == CellKind::outside;
  for (std::size_t i = 0; i < portals.size(); ++i) {
    portals[i].id = PortalId(i);
    portals[i].a = CellId(number[portals[i].a.index()]);
    portals[i].b = CellId(number[portals[i].b.index()]);
  }
  for (Leak& leak : found) {
    if (number[leak.cell.index()] == no_cell) continue;
    leak.cell = CellId(number[leak.cell.index()]);
    if (is_one_room && leak.area_m2 > 0.0) leak.kind = LeakKind::open_side;
    for (Vec3& p : leak.path) p = own.out(p);
    leaks->push_back(std::move(leak));
  }
  if (is_one_room) return one_cell(box, tolerance_m);
  std::vector<std::uint32_t> cell_of_leaf;
  for (const std::uint32_t group : groups.group_of_leaf) cell_of_leaf.push_back(number[group]);
  return {std::move(kept), own.out(std::move(portals)), own.out(with_cells(tree, cell_of_leaf)),
          tolerance_m};
}

}  // namespace

CellComplex build_cells(std::span<const Piece> pieces, const CellComplex::Config& config) {
  return build(pieces, config, nullptr);
}

CellComplex build_cells(std::span<const Piece> pieces, const CellComplex::Config& config,
                        std::vector<Leak>& leaks) {
  leaks.clear();
  return build(pieces, config, &leaks);
}

}  // namespace enfilade
