// Grouping the pieces of each cell: large faces, then objects, then neighbours.
#include "clusters/cluster.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "clusters/neighbourhood.hpp"

namespace enfilade {
namespace {

constexpr double coplanar_relative = 1e-5;  // of the cell's diagonal
constexpr double rounding = 1e-9;           // sizes of a turned building may differ by this share

constexpr std::size_t connected_group = 3;  // smaller connected groups are pooled

// The pieces of one cell, and the groups that they are sorted into.
class CellClusters {
 public:
  CellClusters(const Scene& scene, std::vector<const CellPiece*> pieces, const Frame& own,
               const ClusterConfig& config)
      : scene_(scene), config_(config), pieces_(std::move(pieces)) {
    turned_.reserve(pieces_.size());
    for (const CellPiece* piece : pieces_) {
      Polygon polygon = piece->piece.polygon;
      for (Vec3& p : polygon) p = {glm::dot(own[1], p), glm::dot(own[2], p), glm::dot(own[0], p)};
      box_.add(bounds(polygon));
      turned_.push_back(std::move(polygon));
    }
    for (const Polygon& polygon : turned_) polygons_.push_back(&polygon);
    max_extent_m_ = config.max_extent_share * box_.diagonal();
  }

  std::vector<Cluster> build() {
    Group rest = take_large();
    rest = take_objects(rest);
    take_neighbours(rest);
    std::vector<Cluster> clusters;
    for (Group& group : groups_) clusters.push_back(make(group));
    std::sort(clusters.begin(), clusters.end(), [](const Cluster& a, const Cluster& b) {
      const Vec3 p = a.bounds.center(), q = b.bounds.center();
      return std::tie(p.x, p.y, p.z, a.polygons[0].surface) <
             std::tie(q.x, q.y, q.z, b.polygons[0].surface);
    });
    return clusters;
  }

 private:
  const std::string& object_of(std::size_t i) const {
    return scene_.surfaces[pieces_[i]->piece.surface.index()].object;
  }

  // A group that fits into one cluster stays whole, however long: an object is seen as a whole. A
  // larger one is a mesh, whose parts are limited in size as well.
  void add_split(const Group& group, std::size_t max_size) {
    const double max_extent_m = group.size() > max_size ? max_extent_m_ : 0.0;
    for (Group& part : split_by_position(polygons_, group, max_size, max_extent_m)) {
      std::sort(part.begin(), part.end());
      groups_.push_back(std::move(part));
    }
  }

  // Walls, floors, ceilings: a cluster of several of them would see everything.
  Group take_large() {
    const double long_m = (1.0 - rounding) * config_.large_share * box_.diagonal();
    const double tolerance_m = coplanar_relative * box_.diagonal();
    struct Face {
      std::string object;
      Plane plane;
      Group members;
    };
    std::vector<Face> faces;
    Group rest;
    for (std::size_t i = 0; i < polygons_.size(); ++i) {
      if (bounds(*polygons_[i]).diagonal() < long_m) {
        rest.push_back(i);
        continue;
      }
      const Plane plane = plane_of(*polygons_[i]);
      const auto fits = [&](const Face& face) {
        if (face.object != object_of(i) || glm::dot(face.plane.n, plane.n) < 0.0) return false;
        return lies_in(*polygons_[i], face.plane, tolerance_m);
      };
      auto face = std::find_if(faces.begin(), faces.end(), fits);
      if (face == faces.end()) face = faces.insert(face, Face{object_of(i), plane, {}});
      face->members.push_back(i);
    }
    for (const Face& face : faces) add_split(face.members, config_.max_polygons);
    return rest;
  }

  Group take_objects(const Group& from) {
    std::map<std::string, Group> objects;
    Group rest;
    for (const std::size_t i : from) {
      if (object_of(i).empty()) {
        rest.push_back(i);
      } else {
        objects[object_of(i)].push_back(i);
      }
    }
    for (const auto& [name, members] : objects) add_split(members, config_.max_polygons);
    return rest;
  }

  void take_neighbours(const Group& from) {
    std::vector<const Polygon*> subset;
    for (const std::size_t i : from) subset.push_back(polygons_[i]);
    Group loose;
    for (Group& group : connected_groups(subset, coplanar_relative * box_.diagonal())) {
      for (std::size_t& i : group) i = from[i];
      if (group.size() >= connected_group) {
        add_split(group, config_.max_polygons);
      } else {
        loose.insert(loose.end(), group.begin(), group.end());
      }
    }
    if (!loose.empty()) add_split(loose, std::min(config_.pool_polygons, config_.max_polygons));
  }

  Cluster make(const Group& group) const {
    Cluster cluster;
    cluster.cell = pieces_[group[0]]->cell;
    cluster.object = object_of(group[0]);
    for (const std::size_t i : group) {
      const Piece& piece = pieces_[i]->piece;
      cluster.polygons.push_back({piece.surface, piece.polygon});
      cluster.polygons.back().reversed = piece.reversed;
      cluster.polygons.back().walked_dark = pieces_[i]->unreachable;
      cluster.bounds.add(bounds(piece.polygon));
      cluster.area_m2 += area_m2(piece.polygon);
      if (object_of(i) != cluster.object) cluster.object.clear();
    }
    return cluster;
  }

  const Scene& scene_;
  const ClusterConfig& config_;
  std::vector<const CellPiece*> pieces_;
  std::vector<Polygon> turned_;  ///< into the building's own frame, upwards last
  std::vector<const Polygon*> polygons_;
  Box box_;
  double max_extent_m_ = 0.0;
  std::vector<Group> groups_;
};

}  // namespace

std::vector<Cluster> build_clusters(const Scene& scene, std::span<const CellPiece> pieces,
                                    const ClusterConfig& config, const Frame& own) {
  // Unreachable pieces by themselves: a cluster of both kinds would be linked for its lit pieces.
  std::map<std::pair<CellId, bool>, std::vector<const CellPiece*>> groups;
  for (const CellPiece& piece : pieces) groups[{piece.cell, piece.unreachable}].push_back(&piece);
  std::vector<Cluster> clusters;
  for (auto& [key, members] : groups) {
    for (Cluster& cluster : CellClusters(scene, std::move(members), own, config).build()) {
      cluster.id = ClusterId(clusters.size());
      clusters.push_back(std::move(cluster));
    }
  }
  return clusters;
}

void make_panes_opaque(std::span<Cluster> clusters) {
  for (Cluster& cluster : clusters) {
    for (ClusterPolygon& polygon : cluster.polygons) {
      polygon.pane = false;
      polygon.transmittance.clear();
    }
  }
}

void set_panes(std::span<Cluster> clusters, const Scene& scene) {
  for (Cluster& cluster : clusters) {
    for (ClusterPolygon& polygon : cluster.polygons) {
      const Surface& surface = scene.surfaces[polygon.surface.index()];
      polygon.pane = surface.is_pane();
      polygon.transmittance = polygon.reversed ? Spectrum{} : surface.transmittance;
    }
  }
}

}  // namespace enfilade
