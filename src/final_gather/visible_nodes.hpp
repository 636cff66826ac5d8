// The part of a polygon that a point sees past a few occluders, in closed form, in nodes of its
// hierarchy that are as fine as its light varies.
#pragma once

#include <vector>

#include "base/random.hpp"
#include "geometry/visible_parts.hpp"
#include "hierarchy/cluster_state.hpp"
#include "occluders/occluders.hpp"
#include "occluders/pane_view.hpp"

namespace enfilade {

/// A node of the polygon's hierarchy, its visible form factor, and the factor's first moment about
/// the node's centroid, along the polygon's axes, metres. The nodes of a polygon do not overlap,
/// and cover its visible part.
struct VisibleNode {
  std::uint32_t node;
  double factor = 0.0;  ///< of what passes panes
  Vec2 moment{0.0};
  std::vector<double> tint{};  ///< of what passes, per band (Passage::tint)

  void add(double part, const Vec2& shift) {
    factor += part;
    moment += part * shift;
  }
  /// Returns the irradiance by the node's own affine function of radiosity.
  double irradiance(const PatchForest& forest, std::size_t band) const {
    return factor > 0.0 ? factor_in(band) * forest.radiosity_at(node, band, moment / factor) : 0.0;
  }
  double factor_in(std::size_t band) const {
    return tint.empty() ? factor : factor * tint[band % tint.size()];
  }
  /// Returns the node's own affine function of radiosity at point y of the polygon's plane.
  double radiosity(const PatchForest& forest, std::size_t band, const Vec3& y) const {
    const PatchNode& at = forest.node(node);
    return forest.radiosity_at(node, band,
                               forest.frames()[at.id.root].project(y) - at.shape.centroid);
  }
};

/// Returns the corners in space of a patch, or of a part of one.
Polygon corners_of(const PolygonFrame& frame, const PatchShape& shape);

/// Finds visible nodes of polygons; keeps scratch memory between calls.
class VisibleNodes {
 public:
  explicit VisibleNodes(const Occluders& occluders) : occluders_(&occluders) {}

  /// Replaces `found` by the nodes of `polygon` of `shooter` that p sees (unit normal n, on polygon
  /// `own` or on none), ascending by node. A node is replaced by its children where the deviation
  /// from its affine function may bring more than `least` of irradiance. Returns false, and no
  /// nodes, where too many polygons stand between.
  bool find(const Vec3& p, const Vec3& n, std::uint32_t own, ClusterId shooter,
            const PatchForest& forest, std::uint32_t polygon, double least,
            std::vector<VisibleNode>& found);
  /// The same but for nodes that too many polygons stand before: each is replaced by its children
  /// where its light may differ by more than `least` of irradiance from `ambient`, a radiosity of
  /// the largest band, and is left out where not. Returns true where any node is left.
  bool find_some(const Vec3& p, const Vec3& n, std::uint32_t own, ClusterId shooter,
                 const PatchForest& forest, std::uint32_t polygon, double least, double ambient,
                 std::vector<VisibleNode>& found);
  /// The same past any number of polygons, as one node: the polygon is cut into parts until few
  /// enough stand before each; a part whose factor is below `least_factor` is estimated by random
  /// rays. Returns the variance of the factor.
  double find_by_parts(const Vec3& p, const Vec3& n, std::uint32_t own, ClusterId shooter,
                       const PatchForest& forest, std::uint32_t polygon, double least,
                       double least_factor, Random& random, VisibleNode& found);

 private:
  /// What find_by_parts() asks for, and finds.
  struct ByParts;
  struct Whole;
  bool find_below(const Whole& whole, std::size_t node, std::span<const std::uint32_t> between,
                  std::vector<VisibleNode>& found);
  bool is_shut(const Vec3& p, std::uint32_t own, std::uint32_t polygon) const;
  bool hide_all(const Vec3& p, std::span<const std::uint32_t> occluders);
  void add_visible_parts(const Vec3& p, const Vec3& n, const PatchForest& forest, double least,
                         VisibleNode& sum, TintSum& tint);
  void find_in_part(const PatchShape& shape, std::span<const std::uint32_t> among, int depth,
                    ByParts& by);
  void add_part(const Vec3& p, const Vec3& n, const PatchForest& forest, const PatchShape& shape,
                double least, int cuts, VisibleNode& sum);

  const Occluders* occluders_;
  VisibleParts parts_;
  Polygon corners_;
  std::vector<std::uint32_t> panes_;  ///< before the polygon
  std::vector<DimmedPart> dimmed_;
};

/// Returns the one of `nodes` (ascending) that point y of the polygon lies in; null for none.
const VisibleNode* node_around(std::span<const VisibleNode> nodes, const PatchForest& forest,
                               std::uint32_t polygon, const Vec3& y);

}  // namespace enfilade
