#include "report/plans/level_section.hpp"

#include <cmath>
#include <map>

#include "geometry/clip.hpp"

namespace enfilade {

namespace {

/// Vertices nearer to a cut than this lie on it: a double's noise, not the cells' tolerance.
constexpr double on_plane_m = 1e-9;

using Parts = std::map<CellId, std::vector<Polygon>>;

void sink(const std::vector<BspNode>& nodes, std::int32_t at, Polygon polygon, Parts& parts) {
  const BspNode& node = nodes[static_cast<std::size_t>(at)];
  if (node.front < 0) {
    parts[node.cell].push_back(std::move(polygon));
    return;
  }
  // Where the cut lies in a level plane, the whole of it lies on one side.
  const double dip = std::hypot(node.plane.n.x, node.plane.n.y);
  if (dip < 1e-9) {
    const bool front = node.plane.signed_distance(polygon[0]) >= 0.0;
    sink(nodes, front ? node.front : node.back, std::move(polygon), parts);
    return;
  }
  auto [front, back] = split(polygon, node.plane, on_plane_m);
  if (front.size() >= 3) sink(nodes, node.front, std::move(front), parts);
  if (back.size() >= 3) sink(nodes, node.back, std::move(back), parts);
}

}  // namespace

std::vector<CellSection> level_section(const CellComplex& complex, const Box& box, double z_m) {
  Parts parts;
  const Polygon whole{{box.lo.x, box.lo.y, z_m},
                      {box.hi.x, box.lo.y, z_m},
                      {box.hi.x, box.hi.y, z_m},
                      {box.lo.x, box.hi.y, z_m}};
  if (!complex.nodes().empty()) sink(complex.nodes(), 0, whole, parts);
  std::vector<CellSection> sections;
  for (auto& [cell, polygons] : parts) {
    CellSection section{cell, std::move(polygons), 0.0};
    for (const Polygon& part : section.parts) section.area_m2 += area_m2(part);
    sections.push_back(std::move(section));
  }
  return sections;
}

std::optional<std::pair<Vec3, Vec3>> level_cut(const Polygon& polygon, double z_m) {
  std::vector<Vec3> crossings;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    if ((a.z < z_m) != (b.z < z_m)) crossings.push_back(a + (z_m - a.z) / (b.z - a.z) * (b - a));
  }
  if (crossings.size() != 2) return std::nullopt;
  return std::pair{crossings[0], crossings[1]};
}

}  // namespace enfilade
