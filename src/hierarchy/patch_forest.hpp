// The hierarchy of patches of one cluster: groups, polygons, patches, and their radiosity and
// irradiance.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <boost/container/small_vector.hpp>

#include "base/geometry.hpp"
#include "base/ids.hpp"
#include "base/shared_list.hpp"
#include "clusters/cluster.hpp"
#include "hierarchy/patch_shape.hpp"

namespace enfilade {

/// Names a node of a cluster's hierarchy, the same on every rank whether or not the node has been
/// made there. A patch: `root` is the polygon's number and `path` the way down from the polygon, a
/// leading 1 and then one bit per split. A group (several polygons of the cluster): `root` is
/// group_bit + the group's number, `path` is 1.
struct PatchId {
  static constexpr std::uint32_t group_bit = 0x80000000u;
  std::uint32_t root = 0;
  std::uint32_t path = 1;

  bool is_group() const { return (root & group_bit) != 0; }
  std::uint32_t group() const { return root & ~group_bit; }
  PatchId child(int side) const { return {root, path * 2 + static_cast<std::uint32_t>(side)}; }
  auto operator<=>(const PatchId&) const = default;
};

using BandValues = boost::container::small_vector<double, 3>;

/// A polygon's plane, its axes, its reflectance and exitance.
struct PolygonFrame {
  SurfaceId surface;
  Vec3 origin{0.0}, u{1.0, 0.0, 0.0}, v{0.0, 1.0, 0.0}, n{0.0, 0.0, 1.0};
  BandValues reflectance, exitance;  ///< per band
  BandValues transmittance{};        ///< per band, of a pane; else empty
  std::vector<MeshLine> lines;       ///< candidates for the cuts of the polygon's patches

  Vec3 at(const Vec2& p) const { return origin + p.x * u + p.y * v; }
  Vec2 project(const Vec3& p) const { return {glm::dot(p - origin, u), glm::dot(p - origin, v)}; }
};

/// Returns the frame on a polygon: its origin is the centroid, and its first axis runs along the
/// longest edge, so that a rectangle is cut along its sides. Without light and lines.
PolygonFrame frame_on(const Polygon& polygon);

/// A node of a polygon's binary hierarchy; the two children of a node have consecutive indices.
struct PatchNode {
  PatchShape shape;
  PatchId id;
  std::int32_t parent = -1;
  std::int32_t first_child = -1;
  Vec2 split_axis{0.0};  ///< the second child lies where dot(split_axis, p) >= split_at
  double split_at = 0.0;
  bool leaf() const { return first_child < 0; }
  std::size_t child(int side) const {
    return static_cast<std::size_t>(first_child) + static_cast<std::size_t>(side);
  }
};

/// An inner node over several polygons: children are groups or polygons.
struct GroupNode {
  std::int32_t left = -1, right = -1;  ///< >= 0 a group, < 0 polygon ~value
  std::uint32_t begin = 0, end = 0;    ///< its polygons, a range of PatchForest::order
  Box bounds;
  double area_m2 = 0.0;

  PatchId left_id() const { return id_of(left); }
  PatchId right_id() const { return id_of(right); }
  static PatchId id_of(std::int32_t child) {
    return child < 0 ? PatchId{static_cast<std::uint32_t>(~child), 1}
                     : PatchId{PatchId::group_bit + static_cast<std::uint32_t>(child), 1};
  }
};

/// All nodes of a cluster's hierarchy. Nodes are appended and never move, so a node's index stays
/// valid. Light is kept per node, band and coefficient: the value at the centroid and, for the
/// linear basis, the gradient along the polygon's axes, at (node * bands + band) * terms + term.
class PatchForest {
 public:
  PatchForest() = default;
  /// Makes one patch per polygon with radiosity = exitance, and the groups above the polygons.
  /// `lead_bands`: as Scene::lead_bands.
  PatchForest(const Cluster& cluster, std::vector<PolygonFrame> frames, int bands, int terms,
              int lead_bands = 0);

  std::size_t size() const { return nodes_.size(); }
  int bands() const { return bands_; }
  int terms() const { return terms_; }
  /// Returns the number of bands by whose light alone is decided what deviates and what is lit; the
  /// further ones are shares of it.
  int lead_bands() const { return lead_bands_; }
  const PatchNode& node(std::size_t i) const { return nodes_[i]; }
  std::span<const PolygonFrame> frames() const { return frames_.all(); }
  std::span<const GroupNode> groups() const { return groups_; }
  /// Returns the polygons in the groups' order: a group's polygons are consecutive.
  std::span<const std::uint32_t> order() const { return order_; }
  /// Returns the number of polygons; node k is the whole of polygon k.
  std::size_t polygons() const { return frames_.size(); }

  /// Returns the node with this path, or its deepest ancestor that has been made. Walks down from
  /// the polygon: one step per bit of the path.
  std::size_t find(PatchId id) const;
  /// Makes the two children of a leaf; their light is the parent's, restricted. Returns the first
  /// child.
  std::size_t subdivide(std::size_t leaf);

  std::span<double> radiosity(std::size_t node) { return row(radiosity_, node); }
  std::span<const double> radiosity(std::size_t node) const { return row(radiosity_, node); }
  std::span<const double> radiosities() const { return radiosity_; }
  std::span<double> irradiance(std::size_t node) { return row(irradiance_, node); }
  std::span<const double> irradiance(std::size_t node) const { return row(irradiance_, node); }
  /// Returns the share of the node's cosine-weighted hemisphere that ends on a lit front side, by
  /// rays; negative = not measured.
  float enclosed_share(std::size_t node) const { return enclosed_share_[node]; }
  /// `settled`: further lit polygons do not change it, as all front sides in view are lit.
  void set_enclosed_share(std::size_t node, float share, bool settled) {
    enclosed_share_[node] = share;
    settled_[node] = settled ? 1 : 0;
  }
  bool enclosed_share_settled(std::size_t node) const { return settled_[node] != 0; }
  /// Returns the sum of the estimated errors of the links to a leaf and to what lies above it, over
  /// the leaf's irradiance (largest band); 0 where nothing has been gathered.
  float link_error(std::size_t node) const { return link_error_[node]; }
  void set_link_error(std::size_t node, float share) { link_error_[node] = share; }
  /// Marks the enclosed shares that are not settled as not measured, if they were measured with
  /// clearly fewer lit polygons in view than `lit_polygons` (by more than 1 in 256). A smaller
  /// number of lit polygons changes nothing: radiosities that oscillate about zero would trigger
  /// measurements in every iteration.
  void forget_enclosed_shares_below(std::uint32_t lit_polygons);
  /// Returns per polygon 1 where its radiosity is above zero in some band.
  std::span<const char> lit() const { return lit_; }
  /// Returns the number of polygons whose radiosity is above zero in some band.
  std::uint32_t lit_polygons() const { return lit_polygons_; }
  /// True where the polygon is estimated to receive no light (unreachable_polygons.hpp), as inside
  /// a wall; no light is gathered for it.
  bool unreachable(std::size_t polygon) const { return unreachable_[polygon] != 0; }
  void mark_unreachable(std::size_t polygon) { unreachable_[polygon] = 1; }

  /// Returns the mean radiosity per band of a group's polygons, weighted by area.
  std::span<const double> group_radiosity(std::size_t group) const {
    return {group_radiosity_.data() + group * static_cast<std::size_t>(bands_),
            static_cast<std::size_t>(bands_)};
  }
  /// Returns the standard deviation of radiosity among a group's polygons, weighted by area; worst
  /// band.
  double group_deviation(std::size_t group) const { return group_deviation_[group]; }
  /// Returns the mean exitance of a node in a band.
  double exitance(PatchId node, std::size_t band) const {
    return node.is_group() ? group_exitance_[node.group() * static_cast<std::size_t>(bands_) + band]
                           : frames_[node.root].exitance[band];
  }
  /// Returns the name of the node over all of the cluster: its topmost group, or its only polygon.
  PatchId root() const { return groups_.empty() ? PatchId{} : PatchId{PatchId::group_bit, 1}; }
  /// Returns the RMS difference over the node between its descendants' radiosity and its own affine
  /// function; zero at a leaf.
  double deviation(std::size_t node) const { return deviation_[node]; }

  /// Push-pull (Hanrahan, Salzman and Aupperle 1991): computes the radiosity of every node from the
  /// irradiance gathered at every node. Pushes to the leaves and pulls to the polygons
  /// (area-weighted, exact for the basis). `gathered` is indexed like the light.
  void push_pull(std::span<const double> gathered);
  /// Adds to each node's `width` values the values of all its ancestors. The first 3 * `affine`
  /// values (linear basis) are affine functions over the node and are restricted to it; the others
  /// are constants.
  void push(std::span<double> values, std::size_t width, int affine) const;
  /// Computes from the leaves' irradiance the irradiance and radiosity of every node, and of the
  /// groups.
  void pull();
  /// Keeps the leaves' irradiance as it is, until it is taken or a patch is made.
  void keep_light();
  /// Returns the light that was kept, in the leaves' order, indexed like the light; empty where
  /// there is none.
  std::vector<double> take_kept_light();
  /// Returns the leaf of a polygon that contains point p of its plane.
  std::size_t leaf_at(std::size_t polygon, const Vec3& p) const;
  /// Writes the radiosity (or irradiance) of polygon `polygon`, band by band, at a point of its
  /// plane.
  void evaluate(bool radiosity, std::size_t polygon, const Vec3& p, std::span<double> out) const;
  /// Returns the value of the node's own affine function of radiosity at `shift` from its centroid.
  double radiosity_at(std::size_t node, std::size_t band, const Vec2& shift) const {
    const double* b = radiosity_.data() + node * stride() + band * static_cast<std::size_t>(terms_);
    return b[0] + (terms_ == 3 ? b[1] * shift.x + b[2] * shift.y : 0.0);
  }

  /// Returns the bytes on the heap.
  std::size_t memory_bytes() const;
  /// Gives back the memory that growing vectors have reserved.
  void shrink();

 private:
  friend class ClusterCodec;
  std::size_t add_halves(std::size_t leaf);
  std::int32_t build_group(std::uint32_t begin, std::uint32_t end);
  int widest_axis(const GroupNode& group) const;
  void pull_node(std::size_t parent);
  void reflect(std::size_t node);
  void find_lit();
  void pull_groups();
  void sum_exitances();
  std::span<double> row(std::vector<double>& a, std::size_t i) {
    return {a.data() + i * stride(), stride()};
  }
  std::span<const double> row(const std::vector<double>& a, std::size_t i) const {
    return {a.data() + i * stride(), stride()};
  }
  std::size_t stride() const {
    return static_cast<std::size_t>(bands_) * static_cast<std::size_t>(terms_);
  }

  int bands_ = 1, terms_ = 1, lead_bands_ = 1;
  SharedList<PolygonFrame> frames_;
  std::vector<PatchNode> nodes_;
  std::vector<GroupNode> groups_;
  std::vector<std::uint32_t> order_;
  std::vector<double> radiosity_, irradiance_, deviation_;
  std::vector<double> kept_;  ///< the leaves' irradiance of an earlier iteration, or empty
  std::vector<double> group_radiosity_, group_deviation_, group_exitance_;
  std::vector<float> enclosed_share_, link_error_;
  std::vector<std::uint8_t> settled_;  ///< per node, of its enclosed share
  /// Number of lit polygons in view when the enclosed shares were measured.
  std::uint32_t lit_when_measured_ = 0;
  std::vector<char> lit_;
  std::uint32_t lit_polygons_ = 0;
  std::vector<std::uint8_t> unreachable_;
};

}  // namespace enfilade
