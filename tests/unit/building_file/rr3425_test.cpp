// The building of the paper's size (§5): what comes out of the modeler, and what is cut out of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <queue>
#include <utility>

#include "cells/partition/cell_complex.hpp"
#include "cells/rooms/build_cells.hpp"
#include "clusters/cluster.hpp"
#include "clusters/unreachable_parts.hpp"
#include "unit/modeler/buildings.hpp"

namespace enfilade {
namespace {

std::size_t lights_in(const Scene& scene) {
  return static_cast<std::size_t>(
      std::count_if(scene.surfaces.begin(), scene.surfaces.end(),
                    [](const Surface& s) { return s.exitance[0] > 0.0; }));
}

TEST(Rr3425, HasThePapersSurfacesAndLights) {
  const Scene scene = building_scene(testing::preset("rr3425"));
  EXPECT_EQ(scene.surfaces.size(), 57786u);
  EXPECT_EQ(lights_in(scene), 2000u);
}

/// How many cells can be walked to from `start` through portals.
std::size_t reached_from(const CellComplex& cells, CellId start) {
  std::multimap<CellId, CellId> next;
  for (const Portal& portal : cells.portals()) {
    next.emplace(portal.a, portal.b);
    next.emplace(portal.b, portal.a);
  }
  std::vector<char> seen(cells.cells().size(), 0);
  std::queue<CellId> queue;
  queue.push(start);
  seen[start.index()] = 1;
  std::size_t count = 0;
  for (; !queue.empty(); queue.pop()) {
    ++count;
    const auto [from, to] = next.equal_range(queue.front());
    for (auto it = from; it != to; ++it) {
      if (cells.cells()[it->second.index()].kind == CellKind::outside) continue;
      if (!std::exchange(seen[it->second.index()], 1)) queue.push(it->second);
    }
  }
  return count;
}

TEST(Rr3425, HasThePapersCellsAndClusters) {
  const Scene scene = building_scene(testing::preset("rr3425", {{"probes", "true"}}));
  Warnings warnings;
  const auto pieces = make_pieces(scene, warnings);
  EXPECT_TRUE(warnings.empty());
  const CellComplex cells = build_cells(pieces, {});
  std::vector<CellPiece> parts;
  for (const Piece& piece : pieces) {
    for (CellPiece& part : cells.cut(piece)) parts.push_back(std::move(part));
  }
  parts = cut_unreachable_parts(scene, parts, cells.tolerance_m(), {});
  const auto clusters = build_clusters(scene, parts, {});
  // building_file/presets.cpp says which numbers to move where one of these has changed.
  EXPECT_EQ(cells.open_cells(), 615u);
  EXPECT_EQ(clusters.size(), 12942u);

  std::map<CellId, int> rooms_in;
  for (const Probe& probe : scene.probes) ++rooms_in[cells.locate(probe.p)];
  EXPECT_EQ(rooms_in.size(), scene.probes.size()) << "rooms that share a cell";
  for (const auto& [cell, rooms] : rooms_in) {
    ASSERT_TRUE(cell.valid()) << "a room that is taken for a solid";
    EXPECT_EQ(cells.cells()[cell.index()].kind, CellKind::room);
  }
  EXPECT_GE(reached_from(cells, cells.locate(scene.probes[0].p)), rooms_in.size())
      << "rooms that no door leads to";
}

}  // namespace
}  // namespace enfilade
