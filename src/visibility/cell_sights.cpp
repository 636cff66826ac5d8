#include "visibility/cell_sights.hpp"

#include <algorithm>

#include "visibility/cell_parts.hpp"

namespace enfilade {
namespace {

/// Returns the faces of a box, facing inwards: every line out of the box starts at one of them.
std::vector<SourcePolygon> inner_faces(const Box& box) {
  std::vector<SourcePolygon> faces;
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const bool upper : {false, true}) {
      Polygon face;
      for (int corner = 0; corner < 4; ++corner) {
        Vec3 p(0.0);
        p[axis] = upper ? box.hi[axis] : box.lo[axis];
        p[u] = corner == 1 || corner == 2 ? box.hi[u] : box.lo[u];
        p[v] = corner >= 2 ? box.hi[v] : box.lo[v];
        face.push_back(p);
      }
      Vec3 n(0.0);
      n[axis] = upper ? -1.0 : 1.0;
      faces.push_back({face, Plane{n, glm::dot(n, face[0])}});
    }
  }
  return faces;
}

void sort_once(std::vector<CellId>& cells) {
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
}

}  // namespace

CellSights::CellSights(const CellComplex& complex, std::span<const Cluster> clusters,
                       const SightConfig& config)
    : complex_(complex), config_(config), doorways_(complex), seen_(complex.cells().size()) {
  first_.push_back(0);
  for (const Cluster& cluster : clusters) {
    for (const CellPart& part : parts_by_cell(complex, cluster, 0)) cells_of_.push_back(part.cell);
    if (cells_of_.size() > first_.back() + 1) sticking_out_.push_back(cluster.id);
    first_.push_back(cells_of_.size());
  }
}

std::vector<CellId> CellSights::seen_by(ClusterId receiver) const {
  const std::span<const CellId> own = cells_of(receiver);
  std::vector<CellId> seen = seen_from(own.front());
  for (const CellId cell : own.subspan(1)) {
    const std::vector<CellId>& more = seen_from(cell);
    seen.insert(seen.end(), more.begin(), more.end());
  }
  if (own.size() > 1) sort_once(seen);
  return seen;
}

const std::vector<CellId>& CellSights::seen_from(CellId cell) const {
  std::unique_ptr<std::vector<CellId>>& seen = seen_[cell.index()];
  if (!seen) seen = std::make_unique<std::vector<CellId>>(search(cell));
  return *seen;
}

/// Lines start anywhere in the box of the cell, which may be larger than the cell.
std::vector<CellId> CellSights::search(CellId cell) const {
  Box box = complex_.cells()[cell.index()].bounds;
  box.lo -= Vec3(2.0 * complex_.tolerance_m());
  box.hi += Vec3(2.0 * complex_.tolerance_m());
  std::vector<CellId> seen{cell};
  const bool complete = search_portals(
      doorways_, cell, inner_faces(box), config_.max_passes,
      [&seen](const CellView& view) { seen.push_back(view.cell); }, {}, config_.most_doorways);
  if (!complete) seen = connected_with(cell);
  sort_once(seen);
  return seen;
}

std::vector<CellId> CellSights::connected_with(CellId cell) const {
  std::vector<char> reached(doorways_.cells(), 0);
  std::vector<CellId> cells{cell};
  reached[cell.index()] = 1;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    for (const Doorway& doorway : doorways_.of(cells[i])) {
      if (reached[doorway.leads_to.index()] != 0) continue;
      reached[doorway.leads_to.index()] = 1;
      cells.push_back(doorway.leads_to);
    }
  }
  return cells;
}

}  // namespace enfilade
