// G_cell: a cell sees the cells that a straight line through its portals can reach.
#include <algorithm>
#include <set>

#include "visibility/cluster_graph.hpp"
#include "visibility/portal_search.hpp"

namespace enfilade {

std::vector<std::pair<CellId, CellId>> visible_cells(const CellComplex& complex,
                                                     const VisibilityConfig& config) {
  const DoorwayMap doorways(complex);
  std::set<std::pair<CellId, CellId>> pairs;
  const auto add = [&](CellId a, CellId b) { pairs.emplace(std::min(a, b), std::max(a, b)); };
  for (const Cell& cell : complex.cells()) {
    add(cell.id, cell.id);
    // Every line out of the cell starts at one of its portals.
    for (const Doorway& doorway : doorways.of(cell.id)) {
      add(cell.id, doorway.leads_to);
      const SourcePolygon source{doorway.polygon, doorway.plane};
      search_portals(doorways, doorway.leads_to, {&source, 1}, config.max_passes,
                     [&](const CellView& view) { add(cell.id, view.cell); });
    }
  }
  return {pairs.begin(), pairs.end()};
}

}  // namespace enfilade
