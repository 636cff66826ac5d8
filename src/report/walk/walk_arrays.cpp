#include "report/walk/walk_arrays.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "report/walk/patch_mesh.hpp"

namespace enfilade {
namespace {

/// The brightest light is this many units: half floats end at 65504, and lose digits below 6.1e-5.
constexpr double brightest_units = 32768.0;

/// Collects the arrays, one polygon after the other.
class Collector {
 public:
  Collector(const SolvedScene& solved, const LightChannels& channels, const WalkStoreys& storeys,
            const WalkShares& shares, const Vec3& centre)
      : solved_(solved),
        channels_(channels),
        storeys_(storeys),
        shares_(shares),
        centre_(centre),
        share_light_(shares.names.size()) {}

  void add(const Cluster& cluster, const PatchForest& forest) {
    const auto leaves = leaves_by_polygon(forest);
    for (std::uint32_t k = 0; k < forest.polygons(); ++k) {
      add_polygon(cluster, forest, k);
      add_faces(cluster, forest, patch_mesh(forest, k, leaves[k]));
    }
  }

  WalkArrays arrays() const {
    WalkArrays result;
    BinaryArrays& to = result.arrays;
    to.add("frames", frames_);
    to.add("reflectance", reflectance_);
    to.add("exitance", exitance_);
    to.add("storey", storey_);
    to.add("outside", outside_);
    to.add("point_count", point_count_);
    to.add("face_count", face_count_);
    to.add("points", points_);
    to.add("corner_count", corner_count_);
    to.add("corners", corners_);
    to.add("middles", middles_);
    result.scale = add_light("light", light_, to);
    if (!share_light_.empty()) to.add("lamp", lamp_);
    for (std::size_t i = 0; i < share_light_.size(); ++i)
      result.scales.push_back(add_light("share_" + std::to_string(i), share_light_[i], to));
    result.centre = centre_;
    result.polygons = storey_.size();
    result.faces = corner_count_.size();
    result.corners = corners_.size();
    return result;
  }

 private:
  /// Returns the unit that the light is in.
  static double add_light(const std::string& name, const std::vector<float>& light,
                          BinaryArrays& to) {
    float most = 0.0f;
    for (const float e : light) most = std::max(most, std::abs(e));
    const double unit = most > 0.0f ? most / brightest_units : 1.0;
    std::vector<std::uint16_t> halves;
    halves.reserve(light.size());
    for (const float e : light) halves.push_back(half_float(e / unit));
    to.add(name, halves);
    return unit;
  }

  void add_polygon(const Cluster& cluster, const PatchForest& forest, std::uint32_t k) {
    const PolygonFrame& frame = forest.frames()[k];
    for (const Vec3& axis : {frame.origin - centre_, frame.u, frame.v}) {
      for (int c = 0; c < 3; ++c) frames_.push_back(static_cast<float>(axis[c]));
    }
    append(std::span<const double>(frame.reflectance.data(), frame.reflectance.size()),
           reflectance_);
    append(std::span<const double>(frame.exitance.data(), frame.exitance.size()), exitance_);
    storey_.push_back(
        static_cast<std::uint8_t>(std::min<std::size_t>(storeys_.of(cluster, k), 255)));
    lamp_.push_back(lamp_of(cluster, k));
    outside_.push_back(cluster.cell.valid() && kind(cluster.cell) == CellKind::room ? 0 : 1);
  }

  /// 1 + the share by which the polygon shines.
  std::uint16_t lamp_of(const Cluster& cluster, std::uint32_t k) const {
    if (shares_.names.empty()) return 0;
    const PolygonFrame& wide = shares_.clusters[cluster.id.index()].patches().frames()[k];
    const std::size_t bands = wide.exitance.size() / (1 + shares_.names.size());
    for (std::size_t i = bands; i < wide.exitance.size(); ++i) {
      if (wide.exitance[i] > 0.0) return static_cast<std::uint16_t>(i / bands);
    }
    return 0;
  }

  CellKind kind(CellId cell) const { return solved_.cells.cells()[cell.index()].kind; }

  void add_faces(const Cluster& cluster, const PatchForest& forest, const PatchMesh& mesh) {
    point_count_.push_back(static_cast<std::uint32_t>(mesh.points.size()));
    face_count_.push_back(static_cast<std::uint32_t>(mesh.faces.size()));
    for (const Vec2& p : mesh.points) append(p, points_);
    for (const PatchMesh::Face& face : mesh.faces) {
      const Vec2 middle = forest.node(face.node).shape.centroid;
      corner_count_.push_back(static_cast<std::uint16_t>(face.corners.size()));
      append(middle, middles_);
      for (const std::uint32_t corner : face.corners) {
        corners_.push_back(corner);
        add_vertex(cluster, forest, face.node, mesh.points[corner] - middle);
      }
      add_vertex(cluster, forest, face.node, Vec2(0.0));
    }
  }

  void add_vertex(const Cluster& cluster, const PatchForest& forest, std::size_t node,
                  const Vec2& shift) {
    Spectrum light(static_cast<std::size_t>(forest.bands()));
    irradiance(forest, node, shift, light);
    append(light, light_);
    if (share_light_.empty()) return;
    const PatchForest& wide = shares_.clusters[cluster.id.index()].patches();
    Spectrum all(static_cast<std::size_t>(wide.bands()));
    irradiance(wide, node, shift, all);
    for (std::size_t i = 0; i < share_light_.size(); ++i)
      append(std::span<const double>(all).subspan((i + 1) * light.size(), light.size()),
             share_light_[i]);
  }

  static void irradiance(const PatchForest& forest, std::size_t node, const Vec2& shift,
                         Spectrum& out) {
    const std::span<const double> e = forest.irradiance(node);
    const auto terms = static_cast<std::size_t>(forest.terms());
    for (std::size_t band = 0; band < out.size(); ++band) {
      const double* of = e.data() + band * terms;
      out[band] = of[0] + (terms == 3 ? of[1] * shift.x + of[2] * shift.y : 0.0);
    }
  }

  void append(std::span<const double> solved, std::vector<float>& to) const {
    std::array<double, 3> values{};
    channels_.of(solved, values);
    for (std::size_t c = 0; c < channels_.count(); ++c) to.push_back(static_cast<float>(values[c]));
  }
  static void append(const Vec2& p, std::vector<float>& to) {
    to.push_back(static_cast<float>(p.x));
    to.push_back(static_cast<float>(p.y));
  }

  const SolvedScene& solved_;
  const LightChannels& channels_;
  const WalkStoreys& storeys_;
  const WalkShares& shares_;
  Vec3 centre_;
  std::vector<float> frames_, reflectance_, exitance_, points_, middles_, light_;
  std::vector<std::uint8_t> storey_, outside_;
  std::vector<std::uint32_t> point_count_, face_count_, corners_;
  std::vector<std::uint16_t> corner_count_, lamp_;
  std::vector<std::vector<float>> share_light_;
};

}  // namespace

WalkArrays walk_arrays(const SolvedScene& solved, const LightChannels& channels,
                       const WalkStoreys& storeys, const WalkShares& shares) {
  Box box;
  for (const Cluster& cluster : solved.clusters) box.add(cluster.bounds);
  // Single precision is relative to the building, wherever it stands.
  Collector collector(solved, channels, storeys, shares, box.empty() ? Vec3(0.0) : box.center());
  for (std::size_t c = 0; c < solved.clusters.size(); ++c)
    collector.add(solved.clusters[c], solved.states[c].patches());
  return collector.arrays();
}

}  // namespace enfilade
