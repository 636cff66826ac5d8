// The hierarchy of patches of one cluster, and the light on it.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <boost/container/small_vector.hpp>

#include "base/geometry.hpp"
#include "base/ids.hpp"
#include "clusters/cluster.hpp"

namespace enfilade {

/// Names a node of a cluster's hierarchy, the same on every rank whether or not the node has been
/// made there. A patch: `root` is the polygon's number and `path` the way down from it, a leading 1
/// then one bit a split. A group (several polygons of the cluster): `root` is group_bit + the
/// group's number, `path` is 1.
struct PatchId {
  static constexpr std::uint32_t group_bit = 0x80000000u;
  std::uint32_t root = 0;
  std::uint32_t path = 1;

  bool is_group() const { return (root & group_bit) != 0; }
  std::uint32_t group() const { return root & ~group_bit; }
  PatchId child(int side) const { return {root, path * 2 + static_cast<std::uint32_t>(side)}; }
  auto operator<=>(const PatchId&) const = default;
};

/// Where another polygon touches or crosses one, in that one's frame.
struct MeshLine {
  Vec2 a{0.0}, b{0.0};
};

/// How a patch is cut in two: one half lies where dot(axis, p) < at.
struct PatchCut {
  Vec2 axis{1.0, 0.0};
  double at = 0.0;
};

/// A patch's outline; most are triangles and quads, which take no memory of their own.
using PatchOutline = boost::container::small_vector<Vec2, 4>;

/// A patch's shape in the frame of its polygon, with its area moments.
struct PatchShape {
  PatchOutline vertices;  ///< counter-clockwise
  Vec2 centroid{0.0};
  double area_m2 = 0.0;
  double cxx = 0.0, cxy = 0.0, cyy = 0.0;  ///< covariance of the area, m2

  static PatchShape from(const PatchOutline& vertices);
  /// Unit direction of the greatest extent (first principal axis); the frame's own axis where there
  /// is none.
  Vec2 long_axis() const;
  /// Along the line that parts it best among those that run through it for the most part and leave
  /// neither side a sliver; else through the centroid across the longest axis. Deterministic.
  PatchCut cut(std::span<const MeshLine> lines) const;
  std::pair<PatchShape, PatchShape> halves(const PatchCut& cut) const;
  /// Four points at centroid +- s1 e1 +- s2 e2 (e principal axes, s standard deviations), each with
  /// a quarter of the area: exact for quadratics on any polygon, and on a rectangle the 2 x 2 Gauss
  /// rule.
  std::array<Vec2, 4> quadrature() const;
  /// A point in quarter 0 .. 3 of the area, r1 and r2 in [0, 1): evenly spread where the patch is a
  /// rectangle, else the quadrature point wherever the rectangle of the same moments reaches out of
  /// the patch.
  Vec2 point_in_quarter(int quarter, double r1, double r2) const;
  /// sqrt of the covariance along the principal axes: (s1, s2), metres.
  Vec2 deviations() const;
};

using BandValues = boost::container::small_vector<double, 3>;

/// A polygon's plane, its axes, and what it does to light.
struct PolygonFrame {
  SurfaceId surface;
  Vec3 origin{0.0}, u{1.0, 0.0, 0.0}, v{0.0, 1.0, 0.0}, n{0.0, 0.0, 1.0};
  BandValues reflectance, exitance;  ///< per band
  std::vector<MeshLine> lines;       ///< patches are cut along these where they can be

  Vec3 at(const Vec2& p) const { return origin + p.x * u + p.y * v; }
  Vec2 project(const Vec3& p) const { return {glm::dot(p - origin, u), glm::dot(p - origin, v)}; }
};

/// A node of a polygon's binary hierarchy; its children stand side by side.
struct PatchNode {
  PatchShape shape;
  PatchId id;
  std::int32_t parent = -1;
  std::int32_t first_child = -1;
  Vec2 split_axis{0.0};  ///< the second child lies where dot(split_axis, p) >= split_at
  double split_at = 0.0;
  bool leaf() const { return first_child < 0; }
};

/// An inner node over several polygons: children are groups or polygons.
struct GroupNode {
  std::int32_t left = -1, right = -1;  ///< >= 0 a group, < 0 polygon ~value
  std::uint32_t begin = 0, end = 0;    ///< its polygons, a range of PatchForest::order
  Box bounds;
  double area_m2 = 0.0;
};

/// All nodes of a cluster. Light is kept per node, band and coefficient: value at the centroid, and
/// for the linear basis the gradient along the polygon's axes, so index = (node * bands + band) *
/// terms + term.
class PatchForest {
 public:
  PatchForest() = default;
  PatchForest(const Cluster& cluster, std::vector<PolygonFrame> frames, int bands, int terms);

  std::size_t size() const { return nodes_.size(); }
  int bands() const { return bands_; }
  int terms() const { return terms_; }
  const PatchNode& node(std::size_t i) const { return nodes_[i]; }
  std::span<const PolygonFrame> frames() const { return frames_; }
  std::span<const GroupNode> groups() const { return groups_; }
  std::span<const std::uint32_t> order() const { return order_; }
  /// The node that is its polygon's whole: polygon k is node k.
  std::size_t polygons() const { return frames_.size(); }

  /// The node with this path, or its deepest ancestor that has been made.
  std::size_t find(PatchId id) const;
  /// Makes the two children of a leaf; their light is the parent's, restricted. Returns the first
  /// child.
  std::size_t subdivide(std::size_t leaf);

  std::span<double> radiosity(std::size_t node) { return row(radiosity_, node); }
  std::span<const double> radiosity(std::size_t node) const { return row(radiosity_, node); }
  std::span<const double> radiosities() const { return radiosity_; }
  std::span<double> irradiance(std::size_t node) { return row(irradiance_, node); }
  std::span<const double> irradiance(std::size_t node) const { return row(irradiance_, node); }
  /// Share of the node's cosine-weighted hemisphere that ends on a lit front side, by rays;
  /// negative = not looked at yet.
  float enclosed_share(std::size_t node) const { return enclosed_share_[node]; }
  void set_enclosed_share(std::size_t node, float share) { enclosed_share_[node] = share; }
  /// Forgets the exposures where they were measured with fewer lit polygons in view, give or take
  /// one in 256. Fewer lit polygons leave them as they are, else light that flickers about zero
  /// would have them measured again for ever.
  void forget_enclosed_shares_below(std::uint32_t lit_polygons);
  /// Per polygon: it gives light. And how many of them do.
  std::span<const char> lit() const { return lit_; }
  std::uint32_t lit_polygons() const { return lit_polygons_; }
  /// No light to speak of can reach the polygon (unreachable_polygons.hpp), as inside a wall: it
  /// takes none.
  bool unreachable(std::size_t polygon) const { return unreachable_[polygon] != 0; }
  void mark_unreachable(std::size_t polygon) { unreachable_[polygon] = 1; }

  /// Mean radiosity per band of a group's polygons, by area, and its RMS spread among them (worst
  /// band).
  std::span<const double> group_radiosity(std::size_t group) const {
    return {group_radiosity_.data() + group * static_cast<std::size_t>(bands_),
            static_cast<std::size_t>(bands_)};
  }
  double group_deviation(std::size_t group) const { return group_deviation_[group]; }
  /// Mean exitance of a node: what it gives of its own, not by reflection.
  double exitance(PatchId node, std::size_t band) const {
    return node.is_group() ? group_exitance_[node.group() * static_cast<std::size_t>(bands_) + band]
                           : frames_[node.root].exitance[band];
  }
  /// The name of the node over all of the cluster: its topmost group, or its only polygon.
  PatchId root() const { return groups_.empty() ? PatchId{} : PatchId{PatchId::group_bit, 1}; }
  /// RMS over the node of radiosity minus its own affine function: what its children know better.
  double deviation(std::size_t node) const { return deviation_[node]; }

  /// Irradiance gathered at every node -> radiosity of every node: push to the leaves, pull to the
  /// roots (area-weighted, exact for the basis). `gathered` is indexed like the light.
  void push_pull(std::span<const double> gathered);
  /// Adds to each node's `width` values those of all nodes above it. They begin with `affine`
  /// affine functions over the node, of as many values each as the basis has terms; the rest are
  /// constants.
  void push(std::span<double> values, std::size_t width, int affine) const;
  /// The leaves' irradiance -> irradiance and radiosity of every node, and of the groups.
  void pull();
  /// The leaf of a polygon that point p of its plane lies in.
  std::size_t leaf_at(std::size_t polygon, const Vec3& p) const;
  /// Value of radiosity (or irradiance) of polygon `polygon`, band by band, at a point of its
  /// plane.
  void evaluate(bool radiosity, std::size_t polygon, const Vec3& p, std::span<double> out) const;
  /// Value of the node's own affine function of radiosity at `shift` from its centroid.
  double radiosity_at(std::size_t node, std::size_t band, const Vec2& shift) const {
    const double* b = radiosity_.data() + node * stride() + band * static_cast<std::size_t>(terms_);
    return b[0] + (terms_ == 3 ? b[1] * shift.x + b[2] * shift.y : 0.0);
  }

 private:
  friend class ClusterStateCodec;
  std::size_t add_halves(std::size_t leaf);
  std::span<double> row(std::vector<double>& a, std::size_t i) {
    return {a.data() + i * stride(), stride()};
  }
  std::span<const double> row(const std::vector<double>& a, std::size_t i) const {
    return {a.data() + i * stride(), stride()};
  }
  std::size_t stride() const {
    return static_cast<std::size_t>(bands_) * static_cast<std::size_t>(terms_);
  }

  int bands_ = 1, terms_ = 1;
  std::vector<PolygonFrame> frames_;
  std::vector<PatchNode> nodes_;
  std::vector<GroupNode> groups_;
  std::vector<std::uint32_t> order_;
  void find_lit();
  void pull_groups();
  void sum_exitances();
  std::int32_t build_group(std::uint32_t begin, std::uint32_t end);

  std::vector<double> radiosity_, irradiance_, deviation_;
  std::vector<double> group_radiosity_, group_deviation_, group_exitance_;
  std::vector<float> enclosed_share_;
  std::uint32_t lit_when_measured_ = 0;  ///< lit polygons in view when the exposures were measured
  std::vector<char> lit_;
  std::uint32_t lit_polygons_ = 0;
  std::vector<std::uint8_t> unreachable_;
};

}  // namespace enfilade
