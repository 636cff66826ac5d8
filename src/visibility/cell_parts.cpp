// Pushes each polygon down the tree of cells, cut at every plane that it crosses.
#include "visibility/cell_parts.hpp"

#include <algorithm>
#include <map>

namespace enfilade {
namespace {

// Calls `add(cell, part)` for every part of the polygon, cut as exactly as doubles allow.
template <class Add>
void descend(const CellComplex& complex, const SourcePolygon& whole, Add add) {
  const double fine = 1e-4 * complex.tolerance_m();
  const auto& nodes = complex.nodes();
  std::vector<std::pair<std::size_t, Polygon>> jobs;
  jobs.emplace_back(0, whole.polygon);
  while (!jobs.empty()) {
    auto [at, part] = std::move(jobs.back());
    jobs.pop_back();
    const BspNode& node = nodes[at];
    if (node.front < 0) {
      if (node.cell.valid()) add(node.cell, std::move(part));
      continue;
    }
    const auto front = static_cast<std::size_t>(node.front);
    const auto back = static_cast<std::size_t>(node.back);
    const DistanceRange range = distances(part, node.plane);
    if (range.lowest >= -fine && range.highest <= fine) {
      jobs.emplace_back(glm::dot(whole.plane.n, node.plane.n) >= 0.0 ? front : back,
                        std::move(part));
    } else if (range.lowest >= -fine) {
      jobs.emplace_back(front, std::move(part));
    } else if (range.highest <= fine) {
      jobs.emplace_back(back, std::move(part));
    } else {
      auto [before, behind] = split(part, node.plane, 0.0);
      if (before.size() >= 3) jobs.emplace_back(front, std::move(before));
      if (behind.size() >= 3) jobs.emplace_back(back, std::move(behind));
    }
  }
}

}  // namespace

std::vector<CellPart> parts_by_cell(const CellComplex& complex, const Cluster& cluster,
                                    std::uint32_t first_number) {
  std::vector<CellPart> parts(1);
  parts[0].cell = cluster.cell;
  parts[0].box = cluster.bounds;
  std::map<CellId, CellPart> others;
  for (const ClusterPolygon& polygon : cluster.polygons) {
    const SourcePolygon whole{polygon.polygon, plane_of(polygon.polygon), first_number++};
    descend(complex, whole, [&](CellId cell, Polygon part) {
      if (cell == cluster.cell) return;
      CellPart& other = others[cell];
      other.cell = cell;
      other.box.add(bounds(part));
      other.polygons.push_back({std::move(part), whole.plane, whole.number});
    });
    parts[0].polygons.push_back(whole);
  }
  for (auto& [cell, part] : others) parts.push_back(std::move(part));
  return parts;
}

}  // namespace enfilade
