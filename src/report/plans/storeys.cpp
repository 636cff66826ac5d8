#include "report/plans/storeys.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace enfilade {

namespace {

struct FloorPiece {
  double height_m, headroom_m, area_m2;
};

bool in_room(const PlannedBuilding& building, const Cluster& cluster) {
  const auto& cells = building.cells.cells();
  return cluster.cell.valid() && cluster.cell.index() < cells.size() &&
         cells[cluster.cell.index()].kind == CellKind::room;
}

/// Points spread over a convex polygon, about one a square metre: furniture that stands in its
/// middle does not hide a floor.
std::vector<Vec3> spread_points(const Polygon& polygon, double area) {
  constexpr double golden = 0.6180339887498949;
  const auto count = static_cast<std::size_t>(std::clamp(area, 1.0, 64.0));
  std::vector<Vec3> points;
  std::size_t corner = 1;
  double before = 0.0, own = 0.0;  // area of the fan's triangles up to this one, and of this one
  const auto triangle = [&](std::size_t i) {
    return 0.5 * glm::length(glm::cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]));
  };
  own = triangle(corner);
  for (std::size_t i = 0; i < count; ++i) {
    const double at = (static_cast<double>(i) + 0.5) / static_cast<double>(count) * area;
    while (before + own < at && corner + 2 < polygon.size())
      before += own, own = triangle(++corner);
    const double u = std::sqrt(own > 0.0 ? std::clamp((at - before) / own, 0.0, 1.0) : 0.5);
    const double v = std::fmod((static_cast<double>(i) + 0.5) * golden, 1.0);
    points.push_back((1.0 - u) * polygon[0] + u * (1.0 - v) * polygon[corner] +
                     u * v * polygon[corner + 1]);
  }
  return points;
}

/// Upward ground of rooms with a front side above it (a ceiling), high enough to stand under.
std::vector<FloorPiece> floor_pieces(const PlannedBuilding& building, double least_headroom_m) {
  std::vector<FloorPiece> pieces;
  const bool rooms = std::ranges::any_of(
      building.clusters, [&](const Cluster& cluster) { return in_room(building, cluster); });
  for (const Cluster& cluster : building.clusters) {
    if (rooms && !in_room(building, cluster)) continue;
    for (std::uint32_t k = 0; k < cluster.polygons.size(); ++k) {
      const Polygon& polygon = cluster.polygons[k].polygon;
      if (normal(polygon).z < 0.95) continue;
      const double area = area_m2(polygon);
      const std::vector<Vec3> points = spread_points(polygon, area);
      const std::uint32_t own = building.occluders.global(cluster.id, k);
      for (const Vec3& p : points) {
        const RayHit hit = building.occluders.rays().closest(p, Vec3(0, 0, 1), own);
        if (!hit.any() || !hit.front || hit.distance_m < least_headroom_m) continue;
        pieces.push_back({p.z, hit.distance_m, area / static_cast<double>(points.size())});
      }
    }
  }
  return pieces;
}

/// Area by height, in steps of 1 cm.
std::map<long, double> area_by_height(const std::vector<FloorPiece>& pieces) {
  std::map<long, double> levels;
  for (const FloorPiece& p : pieces) levels[std::lround(100.0 * p.height_m)] += p.area_m2;
  return levels;
}

double area_near(const std::map<long, double>& levels, long height_cm, long reach_cm) {
  double area_m2 = 0.0;
  for (auto i = levels.lower_bound(height_cm - reach_cm);
       i != levels.end() && i->first <= height_cm + reach_cm; ++i) {
    area_m2 += i->second;
  }
  return area_m2;
}

/// The lowest of the heights with most area near them.
std::pair<long, double> busiest(const std::map<long, double>& levels, long reach_cm) {
  std::pair<long, double> best{0, -1.0};
  for (const auto& [height_cm, own] : levels) {
    const double near_m2 = area_near(levels, height_cm, reach_cm);
    if (near_m2 > best.second * (1.0 + 1e-9)) best = {height_cm, near_m2};
  }
  return best;
}

/// The floor's height near a level: that of the piece of it with most area.
double level_near(const std::map<long, double>& levels, long height_cm, long reach_cm) {
  auto best = levels.lower_bound(height_cm - reach_cm);
  for (auto i = best; i != levels.end() && i->first <= height_cm + reach_cm; ++i) {
    if (i->second > best->second) best = i;
  }
  return 0.01 * static_cast<double>(best->first);
}

double median_headroom(std::vector<FloorPiece> pieces, double height_m, double reach_m) {
  std::erase_if(pieces, [&](const auto& p) { return std::abs(p.height_m - height_m) > reach_m; });
  std::sort(pieces.begin(), pieces.end(),
            [](const auto& a, const auto& b) { return a.headroom_m < b.headroom_m; });
  double total = 0.0, below = 0.0;
  for (const auto& p : pieces) total += p.area_m2;
  for (const auto& p : pieces) {
    if ((below += p.area_m2) >= 0.5 * total) return p.headroom_m;
  }
  return 0.0;
}

}  // namespace

Box room_bounds(const PlannedBuilding& building) {
  Box rooms, all;
  for (const Cluster& cluster : building.clusters) {
    all.add(cluster.bounds);
    if (in_room(building, cluster)) rooms.add(cluster.bounds);
  }
  return rooms.empty() ? all : rooms;
}

std::vector<Storey> storeys(const PlannedBuilding& building) {
  const Box box = room_bounds(building);
  const double height_m = box.extent().z;
  // Two metres for buildings; a share of the height for models that are smaller than a room.
  const double apart_m = std::min(2.0, 0.6 * height_m), reach_m = 0.1 * apart_m;
  std::vector<FloorPiece> pieces = floor_pieces(building, 0.9 * apart_m);
  double total_m2 = 0.0;
  for (const FloorPiece& p : pieces) total_m2 += p.area_m2;
  std::vector<Storey> found;
  while (!pieces.empty()) {
    // The level with most area; what lies within a storey of it are landings and steps.
    const auto levels = area_by_height(pieces);
    const long reach_cm = std::lround(100.0 * reach_m);
    const auto [height_cm, near_m2] = busiest(levels, reach_cm);
    if (near_m2 < 0.08 * total_m2) break;
    const double level_m = level_near(levels, height_cm, reach_cm);
    found.push_back({level_m, median_headroom(pieces, level_m, reach_m)});
    std::erase_if(pieces, [&](const auto& p) { return std::abs(p.height_m - level_m) < apart_m; });
  }
  if (found.empty()) found.push_back({box.lo.z, height_m});
  std::sort(found.begin(), found.end(),
            [](const Storey& a, const Storey& b) { return a.floor_m < b.floor_m; });
  return found;
}

}  // namespace enfilade
