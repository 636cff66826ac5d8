// Cells and G_cluster of a row of rooms with doors and furniture. Argument: rooms.
#include <benchmark/benchmark.h>

#include "cells/partition/cell_complex.hpp"
#include "cells/rooms/build_cells.hpp"
#include "clusters/cluster.hpp"
#include "unit/cells/rooms/plan_scenes.hpp"
#include "visibility/cluster_graph.hpp"

namespace enfilade::bench {
namespace {

/// Rooms of 4 x 4 m in a row, a door between each two, eight boxes in each.
plan::Plan row_of_rooms(std::int64_t rooms) {
  plan::Plan plan;
  plan.box({0, 0, 0}, {4.0 * static_cast<double>(rooms), 4, 2.5}, true);
  for (std::int64_t room = 0; room < rooms; ++room) {
    const double x = 4.0 * static_cast<double>(room);
    if (room > 0) plan.wall_with_door(x, 0, 4, 2.5, 1.5, 2.4, 2);
    for (int i = 0; i < 8; ++i) {
      const Vec3 at(x + 0.6 + 0.8 * (i % 4), i < 4 ? 0.3 : 3.3, 0.2);
      plan.box(at, at + Vec3(0.4, 0.4, 0.8), false);
    }
  }
  return plan;
}

std::vector<CellPiece> cut(const CellComplex& cells, const std::vector<Piece>& pieces) {
  std::vector<CellPiece> all;
  for (const Piece& piece : pieces) {
    for (const CellPiece& part : cells.cut(piece)) all.push_back(part);
  }
  return all;
}

void BM_BuildCells(benchmark::State& state) {
  const std::vector<Piece> pieces = row_of_rooms(state.range(0)).pieces();
  for (auto _ : state) benchmark::DoNotOptimize(build_cells(pieces, {}));
  state.counters["pieces_per_second"] = benchmark::Counter(
      static_cast<double>(pieces.size()), benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(BM_BuildCells)->Arg(4)->Arg(16)->Unit(benchmark::kMillisecond);

void BM_VisibleClusters(benchmark::State& state) {
  const plan::Plan plan = row_of_rooms(state.range(0));
  const std::vector<Piece> pieces = plan.pieces();
  const CellComplex cells = build_cells(pieces, {});
  const std::vector<CellPiece> parts = cut(cells, pieces);
  const std::vector<Cluster> clusters = build_clusters(plan.scene(), parts, {});
  std::size_t edges = 0;
  for (auto _ : state) edges = visible_clusters(cells, clusters).edges();
  state.counters["clusters"] = static_cast<double>(clusters.size());
  state.counters["pairs_per_second"] =
      benchmark::Counter(static_cast<double>(edges), benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(BM_VisibleClusters)->Arg(4)->Arg(16)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace enfilade::bench
