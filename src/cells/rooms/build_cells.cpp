// From pieces to cells: planes, partition, interfaces, merging, portals; useless cells are left
// out.
#include <algorithm>
#include <cmath>

#include "cells/merging/leaf_merge.hpp"
#include "cells/partition/apertures.hpp"
#include "cells/partition/bsp.hpp"
#include "cells/partition/cell_complex.hpp"
#include "cells/partition/interface.hpp"
#include "cells/partition/plane_set.hpp"
#include "cells/partition/portal_build.hpp"
#include "cells/rooms/build_cells.hpp"
#include "cells/rooms/floor_steps.hpp"
#include "cells/rooms/leaks.hpp"
#include "cells/rooms/own_frame.hpp"
#include "cells/rooms/pruning.hpp"
#include "cells/rooms/stairwells.hpp"

namespace enfilade {
namespace {

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

/// The building in its own frame, cut into leaves that are grouped into rooms.
struct Partition {
  std::vector<Piece> pieces;
  double tolerance_m = 0.0;
  PlaneSet planes;
  Region inner_box, outer_box;  ///< of all pieces; a little larger, so that there is an outside
  BspTree tree;
  std::vector<LeafInterface> interfaces;
  LeafGroups groups;
};

const Vec3 up_axis(1, 0, 0);                // the own frame's first axis
constexpr double max_tolerance_m = 2e-3;    // see CellComplex::Config::tolerance_relative
constexpr double outside_margin = 1e-3;     // of the diagonal: the layer of outside all around
constexpr double sliver_tolerances = 0.01;  // openings thinner than that are rounding

Partition partition(std::vector<Piece> pieces, const CellComplex::Config& config) {
  Partition made;
  std::vector<Vec3> points;
  Box box;
  for (const Piece& piece : pieces) {
    points.insert(points.end(), piece.polygon.begin(), piece.polygon.end());
    box.add(bounds(piece.polygon));
  }
  const Frame axes{Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  const double diagonal = box.diagonal();
  made.tolerance_m = std::min(config.tolerance_relative * diagonal, max_tolerance_m);
  made.planes = find_planes(pieces, made.tolerance_m);
  made.inner_box = box_region(points, axes, 0.0);
  made.outer_box = box_region(points, axes, outside_margin * diagonal);
  made.tree = build_bsp(pieces, made.planes, made.outer_box, config, made.tolerance_m);
  made.interfaces = find_interfaces(made.tree, sliver_tolerances * made.tolerance_m);
  const MergeConfig merging;
  const ApertureConfig apertures{up_axis, made.tolerance_m, merging.framed_share};
  const auto across = frame_apertures(made.interfaces, made.tree, made.planes, apertures);
  if (!across.empty()) {
    cut_leaves(made.tree, across, pieces, made.planes, made.tolerance_m);
    made.interfaces = find_interfaces(made.tree, sliver_tolerances * made.tolerance_m);
    frame_apertures(made.interfaces, made.tree, made.planes, apertures);
  }
  std::vector<double> volumes;
  for (const Region& leaf : made.tree.leaves) volumes.push_back(volume_m3(leaf));
  made.groups = merge_leaves(volumes, find_touching(made.tree.leaves, made.outer_box),
                             made.interfaces, merging);
  made.pieces = std::move(pieces);
  return made;
}

/// The cells that have a number, in its order, and the portals between them under their new names.
std::vector<Cell> renumber(const std::vector<Cell>& cells, std::span<const std::uint32_t> number,
                           std::vector<Portal>& portals) {
  std::vector<Cell> kept;
  for (const Cell& cell : cells) {
    if (number[cell.id.index()] == CellId::none_value) continue;
    kept.push_back(cell);
    kept.back().id = CellId(kept.size() - 1);
  }
  for (std::size_t i = 0; i < portals.size(); ++i) {
    portals[i].id = PortalId(i);
    portals[i].a = CellId(number[portals[i].a.index()]);
    portals[i].b = CellId(number[portals[i].b.index()]);
  }
  return kept;
}

/// The leaks of the cells that are kept, in the scene's coordinates.
void hand_over(std::vector<Leak>& found, std::span<const std::uint32_t> number, bool is_one_room,
               const OwnFrame& own, std::vector<Leak>& leaks) {
  for (Leak& leak : found) {
    if (number[leak.cell.index()] == CellId::none_value) continue;
    leak.cell = CellId(number[leak.cell.index()]);
    if (is_one_room && leak.area_m2 > 0.0) leak.kind = LeakKind::open_side;
    for (Vec3& p : leak.path) p = own.out(p);
    leaks.push_back(std::move(leak));
  }
}

CellComplex build(std::span<const Piece> given, const CellComplex::Config& config,
                  std::vector<Leak>* leaks) {
  Box box;
  for (const Piece& piece : given) box.add(bounds(piece.polygon));
  if (given.empty() || box.diagonal() <= 0.0) return one_cell(box, 0.0);

  const OwnFrame own(given, box.center());
  Partition made = partition(own.in(given), config);
  auto& [pieces, tolerance_m, planes, inner_box, outer_box, tree, interfaces, groups] = made;
  CutSpace space{pieces, planes, tree, interfaces, groups, up_axis, tolerance_m};
  LeafCutter cutter(space);
  cut_at_steps(space, cutter, StepConfig{});
  cut_stairwells(space, cutter, StairwellConfig{});

  const std::vector<char> touches = find_touching(tree.leaves, outer_box);
  const std::vector<Cell> cells = describe_cells(tree.leaves, groups, touches, inner_box, own);
  std::vector<Portal> portals =
      build_portals(interfaces, groups.group_of_leaf, planes.planes, tolerance_m);
  std::vector<Leak> found;
  if (leaks != nullptr) found = find_leaks(space, cutter, portals, outer_box, touches, groups.lost);

  const CellComplex all(cells, portals, nodes_with_cells(tree, groups.group_of_leaf), tolerance_m);
  const std::vector<std::uint32_t> number = drop_useless_cells(pieces, all, portals);
  std::vector<Cell> kept = renumber(cells, number, portals);
  // Nothing encloses anything: the scene is one room, wherever a point lies.
  const bool is_one_room = kept.size() == 1 && kept[0].kind == CellKind::outside;
  if (leaks != nullptr) hand_over(found, number, is_one_room, own, *leaks);
  if (is_one_room) return one_cell(box, tolerance_m);
  std::vector<std::uint32_t> cell_of_leaf;
  for (const std::uint32_t group : groups.group_of_leaf) cell_of_leaf.push_back(number[group]);
  return {std::move(kept), own.out(std::move(portals)),
          own.out(nodes_with_cells(tree, cell_of_leaf)), tolerance_m};
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
