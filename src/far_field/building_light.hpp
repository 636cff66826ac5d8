// The light that the nodes of a building's tree send, by direction.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "clusters/building_tree.hpp"
#include "geometry/polygon.hpp"
#include "hierarchy/cluster_state.hpp"
#include "scene/scene.hpp"

namespace enfilade {

/// Returns the number of numbers in a ClusterLight.
constexpr std::size_t cluster_light_size(std::size_t bands) { return (directions + 1) * bands + 4; }

/// What is known everywhere of a cluster's light, in few numbers: per band the power that it sends
/// to each of the six directions (area times radiosity, as axis_shares of the polygons' normals);
/// per band the power that it reflects; then, of the polygons' radiosities B (worst band), the sums
/// of area * B and area * B^2, the largest B, and the number of lit polygons.
using ClusterLight = std::vector<double>;

ClusterLight light_of(const ClusterState& cluster);

/// The light of all nodes: the clusters' is set, that of the nodes above is summed.
class BuildingLight {
 public:
  /// All clusters send their exitance. `tree` must outlive it.
  BuildingLight(const BuildingTree& tree, const Scene& scene, std::span<const Cluster> clusters);

  void set(ClusterId cluster, std::span<const double> light);
  std::span<const double> of(ClusterId cluster) const { return row(tree_.leaf_of(cluster)); }
  /// Scales the reflected part of a cluster's light, per band by 1 + change.
  void correct(ClusterId cluster, std::span<const double> changes);
  /// Sums the light of the inner nodes; necessary after set() and correct().
  void sum();

  std::size_t bands() const { return bands_; }
  /// Returns the mean radiosity of the node's polygons that face direction w, worst band.
  double radiosity(std::uint32_t node, const Vec3& w) const;
  /// Returns the reflected part of that radiosity, in a band.
  double reflected(std::uint32_t node, std::size_t band, const Vec3& w) const;
  /// Writes that of all bands; 0 where it is below zero in the band's lead band.
  void reflected(std::uint32_t node, const Vec3& w, std::span<double> out, std::size_t step) const;
  /// Returns the mean exitance of the node's polygons, whichever way they face, in a band.
  double emitted(std::uint32_t node, std::size_t band) const;
  /// Returns what the node sends to direction w: its radiosity times the area that faces w, worst
  /// band.
  double intensity(std::uint32_t node, const Vec3& w) const;
  /// Returns the largest mean radiosity (worst band), over the node's cells and the six directions,
  /// of the polygons that face the direction; where the node is a part of one cell, over its own
  /// polygons.
  double brightest(std::uint32_t node) const { return brightest_[node]; }
  /// Returns the power that the node sends, all directions together, worst band.
  double power(std::uint32_t node) const;
  /// What drawing a cluster needs of a node, in one line of the cache.
  struct Draw {
    std::array<float, directions> weight{};  ///< by direction: power (worst band) and area, mixed
    float all = 0.0f;                        ///< half of their sum
    float size2 = 0.0f;                      ///< m2: a quarter of the squared diagonal
    std::array<float, 3> center{};
  };
  const Draw& draw(std::uint32_t node) const { return draws_[node]; }
  struct PolygonLight {
    Plane plane;
    Vec3 center{0.0};
    float area_m2 = 0.0f;
    float emitted = 0.0f;  ///< area times exitance, worst band
    float power =
        0.0f;  ///< estimated: what it emits, and its share by area of what its cluster reflects
  };
  std::span<const PolygonLight> polygons(ClusterId cluster) const {
    return std::span(polygons_).subspan(
        first_polygon_[cluster.index()],
        first_polygon_[cluster.index() + 1] - first_polygon_[cluster.index()]);
  }
  double reflected_power(std::uint32_t node, std::size_t band) const {
    return std::max(0.0, row(node)[directions * bands_ + band]);
  }
  /// Returns the standard deviation of radiosity among the node's polygons, weighted by area; worst
  /// band.
  double deviation(std::uint32_t node) const;
  /// Returns the largest radiosity of a polygon, worst band.
  double most(std::uint32_t node) const { return row(node)[(directions + 1) * bands_ + 2]; }
  /// Returns the number of polygons whose radiosity is above zero.
  double lit_polygons(std::uint32_t node) const { return row(node)[(directions + 1) * bands_ + 3]; }
  bool is_dark(std::uint32_t node) const { return lit_polygons(node) <= 0.0; }

  const BuildingTree& tree() const { return tree_; }

 private:
  double reflected_toward(std::uint32_t node, std::size_t band,
                          const std::array<double, directions>& share) const;
  void share_reflected(ClusterId cluster);
  void make_draw(std::uint32_t node, double mean);
  double brightest_face(std::uint32_t node) const;
  const double* emitted_row(std::uint32_t node) const {
    return emitted_.data() + node * directions * bands_;
  }
  std::span<const double> row(std::uint32_t node) const {
    return {rows_.data() + node * width_, width_};
  }
  std::span<double> row(std::uint32_t node) { return {rows_.data() + node * width_, width_}; }

  const BuildingTree& tree_;
  std::size_t bands_, lead_bands_, width_;
  std::vector<double> rows_;            ///< ClusterLight of each node
  std::vector<double> emitted_;         ///< per node: power by direction and band that it emits
  std::vector<Draw> draws_;             ///< by node
  std::vector<double> brightest_;       ///< by node
  std::vector<PolygonLight> polygons_;  ///< of cluster c from first_polygon_[c] on
  std::vector<std::uint32_t> first_polygon_;
};

}  // namespace enfilade
