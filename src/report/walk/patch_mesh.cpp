#include "report/walk/patch_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace enfilade {
namespace {

constexpr double grid_m = 1e-6;

/// Adds the point to the leaves that it lies in or on the border of. What lies on the cut between
/// two halves lies in both.
class FaceFinder {
 public:
  FaceFinder(const PatchForest& forest, PatchMesh& mesh) : forest_(forest), mesh_(mesh) {
    for (std::size_t i = 0; i < mesh.faces.size(); ++i) face_of_[mesh.faces[i].node] = i;
  }
  void add(std::size_t node, std::uint32_t point) {
    const PatchNode& n = forest_.node(node);
    if (n.leaf()) {
      mesh_.faces[face_of_.at(node)].corners.push_back(point);
      return;
    }
    const double beyond_m = glm::dot(n.split_axis, mesh_.points[point]) - n.split_at;
    if (beyond_m < grid_m) add(n.child(0), point);
    if (beyond_m > -grid_m) add(n.child(1), point);
  }

 private:
  const PatchForest& forest_;
  PatchMesh& mesh_;
  std::map<std::size_t, std::size_t> face_of_;
};

void sort_round(const Vec2& middle, const std::vector<Vec2>& points,
                std::vector<std::uint32_t>& corners) {
  std::vector<std::pair<double, std::uint32_t>> by_angle;
  for (const std::uint32_t corner : corners) {
    const Vec2 d = points[corner] - middle;
    by_angle.emplace_back(std::atan2(d.y, d.x), corner);
  }
  std::ranges::sort(by_angle);
  for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = by_angle[i].second;
}

}  // namespace

PatchMesh patch_mesh(const PatchForest& forest, std::uint32_t polygon,
                     const std::vector<std::size_t>& leaves) {
  PatchMesh mesh;
  std::map<std::pair<long long, long long>, std::uint32_t> known;
  for (const std::size_t leaf : leaves) {
    mesh.faces.push_back({leaf, {}});
    for (const Vec2& corner : forest.node(leaf).shape.vertices) {
      const std::pair key(std::llround(corner.x / grid_m), std::llround(corner.y / grid_m));
      if (known.try_emplace(key, static_cast<std::uint32_t>(mesh.points.size())).second)
        mesh.points.push_back(corner);
    }
  }
  FaceFinder finder(forest, mesh);
  for (std::uint32_t i = 0; i < mesh.points.size(); ++i) finder.add(polygon, i);
  for (PatchMesh::Face& face : mesh.faces)
    sort_round(forest.node(face.node).shape.centroid, mesh.points, face.corners);
  return mesh;
}

std::vector<std::vector<std::size_t>> leaves_by_polygon(const PatchForest& forest) {
  std::vector<std::vector<std::size_t>> leaves(forest.polygons());
  for (std::size_t i = 0; i < forest.size(); ++i) {
    if (forest.node(i).leaf()) leaves[forest.node(i).id.root].push_back(i);
  }
  return leaves;
}

}  // namespace enfilade
