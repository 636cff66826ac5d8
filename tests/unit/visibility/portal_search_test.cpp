// Sequences of portals: in which order cells are entered, and how long sequences may get.
#include "visibility/portal_search.hpp"

#include <gtest/gtest.h>
#include <pthread.h>

namespace enfilade {
namespace {

Polygon upright_square(double x, double y) {
  return {{x, y, 0}, {x, y + 1, 0}, {x, y + 1, 1}, {x, y, 1}};
}

/// Cells 0 .. `portals` in a row along x, 1 m each; portal i leads from cell i into cell i + 1.
CellComplex row_of_cells(std::uint32_t portals) {
  std::vector<Cell> cells(portals + 1);
  std::vector<Portal> all;
  for (std::uint32_t i = 0; i <= portals; ++i) cells[i].id = CellId(i);
  for (std::uint32_t i = 0; i < portals; ++i) {
    all.push_back({PortalId(i), CellId(i + 1), CellId(i), upright_square(i + 1.0, 0.0)});
  }
  return CellComplex(std::move(cells), std::move(all), {}, 1e-5);
}

/// A wall of the first cell that looks along the row.
SourcePolygon end_wall() {
  const Polygon polygon = upright_square(0.0, 0.0);
  return {polygon, plane_of(polygon), 0};
}

std::vector<std::uint32_t> entered(const CellComplex& complex, int max_passes,
                                   const IsHidden& is_hidden = {}) {
  std::vector<std::uint32_t> cells;
  const SourcePolygon source = end_wall();
  search_portals(
      DoorwayMap(complex), CellId(0), {&source, 1}, max_passes,
      [&](const CellView& view) { cells.push_back(view.cell.value); }, is_hidden);
  return cells;
}

TEST(PortalSearch, EntersACellOnceForEachSequence) {
  // Cells 0 and 3 are joined by two doorways: through cell 1 and through cell 2.
  std::vector<Cell> cells(5);
  for (std::uint32_t i = 0; i < 5; ++i) cells[i].id = CellId(i);
  const auto portal = [](int id, int from, int to, double x, double y0, double y1) {
    return Portal{
        PortalId(id), CellId(to), CellId(from), {{x, y0, 0}, {x, y1, 0}, {x, y1, 1}, {x, y0, 1}}};
  };
  const CellComplex complex(std::move(cells),
                            {portal(0, 0, 1, 1.0, 0.0, 0.4), portal(1, 0, 2, 1.0, 0.6, 1.0),
                             portal(2, 1, 3, 2.0, 0.0, 0.4), portal(3, 2, 3, 2.0, 0.6, 1.0),
                             portal(4, 3, 4, 3.0, 0.0, 1.0)},
                            {}, 1e-5);
  EXPECT_EQ(entered(complex, 2), (std::vector<std::uint32_t>{1, 3, 4, 2, 3, 4}));
}

TEST(PortalSearch, AHiddenWindowEndsTheSequence) {
  const auto hidden = [](const WindowView& view) { return view.path.size() == 2; };
  EXPECT_EQ(entered(row_of_cells(5), 2, hidden), (std::vector<std::uint32_t>{1, 2}));
}

TEST(PortalSearch, APathOfItsOwnBeginsWithoutWindows) {
  // Without a single pass every doorway begins a path that knows the source and itself alone.
  std::vector<std::size_t> lengths;
  const auto hidden = [&](const WindowView& view) {
    lengths.push_back(view.path.size());
    return false;
  };
  EXPECT_EQ(entered(row_of_cells(4), 0, hidden), (std::vector<std::uint32_t>{1, 2, 3, 4}));
  EXPECT_EQ(lengths, (std::vector<std::size_t>{0, 0, 0, 0}));
}

TEST(PortalSearch, AnySequenceFitsOnASmallStack) {
  // Layered walls of real buildings make searches of thousands of steps.
  constexpr std::uint32_t portals = 2000;
  static std::vector<std::uint32_t> cells;
  pthread_attr_t small;
  pthread_attr_init(&small);
  pthread_attr_setstacksize(&small, 128 * 1024);
  pthread_t thread;
  const auto run = [](void*) -> void* {
    cells = entered(row_of_cells(portals), 2);
    return nullptr;
  };
  ASSERT_EQ(pthread_create(&thread, &small, run, nullptr), 0);
  pthread_join(thread, nullptr);
  pthread_attr_destroy(&small);
  ASSERT_EQ(cells.size(), portals);
  for (std::uint32_t i = 0; i < portals; ++i) EXPECT_EQ(cells[i], i + 1);
}

}  // namespace
}  // namespace enfilade
