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
            const Vec3& centre)
      : solved_(solved), channels_(channels), storeys_(storeys), centre_(centre) {}

  void add(const Cluster& cluster, const PatchForest& forest) {
    const auto leaves = leaves_by_polygon(forest);
    for (std::uint32_t k = 0; k < forest.polygons(); ++k) {
      add_polygon(cluster, forest, k);
      add_faces(forest, patch_mesh(forest, k, leaves[k]));
    }
  }

  WalkArrays arrays() const {
    WalkArrays result;
    float most = 0.0f;
    for (const float e : light_) most = std::max(most, std::abs(e));
    result.scale = most > 0.0f ? most / brightest_units : 1.0;
    std::vector<std::uint16_t> halves;
    halves.reserve(light_.size());
    for (const float e : light_) halves.push_back(half_float(e / result.scale));
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
    to.add("light", halves);
    result.centre = centre_;
    result.polygons = storey_.size();
    result.faces = corner_count_.size();
    result.corners = corners_.size();
    return result;
  }

 private:
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
    outside_.push_back(cluster.cell.valid() && kind(cluster.cell) == CellKind::room ? 0 : 1);
  }

  CellKind kind(CellId cell) const { return solved_.cells.cells()[cell.index()].kind; }

  void add_faces(const PatchForest& forest, const PatchMesh& mesh) {
    point_count_.push_back(static_cast<std::uint32_t>(mesh.points.size()));
    face_count_.push_back(static_cast<std::uint32_t>(mesh.faces.size()));
    for (const Vec2& p : mesh.points) append(p, points_);
    Spectrum light(static_cast<std::size_t>(forest.bands()));
    for (const PatchMesh::Face& face : mesh.faces) {
      const Vec2 middle = forest.node(face.node).shape.centroid;
      corner_count_.push_back(static_cast<std::uint16_t>(face.corners.size()));
      append(middle, middles_);
      for (const std::uint32_t corner : face.corners) {
        corners_.push_back(corner);
        irradiance(forest, face.node, mesh.points[corner] - middle, light);
        append(light, light_);
      }
      irradiance(forest, face.node, Vec2(0.0), light);
      append(light, light_);
    }
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
  Vec3 centre_;
  std::vector<float> frames_, reflectance_, exitance_, points_, middles_, light_;
  std::vector<std::uint8_t> storey_, outside_;
  std::vector<std::uint32_t> point_count_, face_count_, corners_;
  std::vector<std::uint16_t> corner_count_;
};

}  // namespace

WalkArrays walk_arrays(const SolvedScene& solved, const LightChannels& channels,
                       const WalkStoreys& storeys) {
  Box box;
  for (const Cluster& cluster : solved.clusters) box.add(cluster.bounds);
  // Single precision is relative to the building, wherever it stands.
  Collector collector(solved, channels, storeys, box.empty() ? Vec3(0.0) : box.center());
  for (std::size_t c = 0; c < solved.clusters.size(); ++c)
    collector.add(solved.clusters[c], solved.states[c].patches());
  return collector.arrays();
}

}  // namespace enfilade
