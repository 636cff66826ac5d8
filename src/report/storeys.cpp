#include "report/storeys.hpp"

#include <algorithm>
#include <cmath>

namespace enfilade {

namespace {

struct FloorPiece {
  double height_m, headroom_m, area_m2;
};

/// Upward polygons with a front side above them (a ceiling), high enough to stand under.
std::vector<FloorPiece> floor_pieces(const SolvedScene& solved, double least_headroom_m) {
  std::vector<FloorPiece> pieces;
  for (const ClusterState& state : solved.states) {
    const PatchForest& forest = state.patches();
    for (std::uint32_t k = 0; k < forest.polygons(); ++k) {
      const PolygonFrame& frame = forest.frames()[k];
      if (frame.n.z < 0.95) continue;
      const Vec3 p = frame.at(forest.node(k).shape.centroid);
      const std::uint32_t own = solved.occluders.global(state.id(), k);
      const RayHit hit = solved.occluders.rays().closest(p, Vec3(0, 0, 1), own);
      if (!hit.any() || !hit.front || hit.distance_m < least_headroom_m) continue;
      pieces.push_back({p.z, hit.distance_m, forest.node(k).shape.area_m2});
    }
  }
  return pieces;
}

double area_near(const std::vector<FloorPiece>& pieces, double height_m, double reach_m) {
  double area_m2 = 0.0;
  for (const FloorPiece& p : pieces) {
    if (std::abs(p.height_m - height_m) <= reach_m) area_m2 += p.area_m2;
  }
  return area_m2;
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

Box room_bounds(const SolvedScene& solved) {
  Box rooms, all;
  for (const Cluster& cluster : solved.clusters) {
    all.add(cluster.bounds);
    const bool known = cluster.cell.valid() && cluster.cell.index() < solved.cells.cells().size();
    if (known && solved.cells.cells()[cluster.cell.index()].kind == CellKind::room) {
      rooms.add(cluster.bounds);
    }
  }
  return rooms.empty() ? all : rooms;
}

std::vector<Storey> storeys(const SolvedScene& solved) {
  const Box box = room_bounds(solved);
  const double height_m = box.extent().z;
  // Two metres for buildings; a share of the height for models that are smaller than a room.
  const double apart_m = std::min(2.0, 0.6 * height_m), reach_m = 0.1 * apart_m;
  std::vector<FloorPiece> pieces = floor_pieces(solved, 0.9 * apart_m);
  const double total_m2 = area_near(pieces, 0.0, 1e30);
  std::vector<Storey> found;
  while (!pieces.empty()) {
    // The level with most area; what lies within a storey of it are landings and steps.
    const auto most =
        std::max_element(pieces.begin(), pieces.end(), [&](const auto& a, const auto& b) {
          const double near_a = area_near(pieces, a.height_m, reach_m);
          const double near_b = area_near(pieces, b.height_m, reach_m);
          return near_a != near_b ? near_a < near_b : a.height_m > b.height_m;
        });
    const double level_m = most->height_m;
    if (area_near(pieces, level_m, reach_m) < 0.08 * total_m2) break;
    found.push_back({level_m, median_headroom(pieces, level_m, reach_m)});
    std::erase_if(pieces, [&](const auto& p) { return std::abs(p.height_m - level_m) < apart_m; });
  }
  if (found.empty()) found.push_back({box.lo.z, height_m});
  std::sort(found.begin(), found.end(),
            [](const Storey& a, const Storey& b) { return a.floor_m < b.floor_m; });
  return found;
}

}  // namespace enfilade
