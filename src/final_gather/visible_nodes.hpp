// What a point sees of a polygon past what few others hide, in closed form: as fine as its light
// varies.
#pragma once

#include <vector>

#include "geometry/visible_parts.hpp"
#include "hierarchy/cluster_state.hpp"
#include "occluders/occluders.hpp"

namespace enfilade {

/// A node of the polygon's hierarchy, its visible form factor, and the factor's first moment about
/// the node's centroid, along the polygon's axes, metres. Nodes cover what is in view of the
/// polygon, each once.
struct VisibleNode {
  std::uint32_t node;
  double factor = 0.0;
  Vec2 moment{0.0};

  void add(double part, const Vec2& shift) {
    factor += part;
    moment += part * shift;
  }
  /// What the node's own affine function of radiosity brings.
  double irradiance(const PatchForest& forest, std::size_t band) const {
    return factor > 0.0 ? factor * forest.radiosity_at(node, band, moment / factor) : 0.0;
  }
  /// That function at point y of the polygon's plane.
  double radiosity(const PatchForest& forest, std::size_t band, const Vec3& y) const {
    const PatchNode& at = forest.node(node);
    return forest.radiosity_at(node, band,
                               forest.frames()[at.id.root].project(y) - at.shape.centroid);
  }
};

/// Looks from points at polygons; keeps scratch memory between calls.
class VisibleNodes {
 public:
  explicit VisibleNodes(const Occluders& occluders) : occluders_(&occluders) {}

  /// From p (unit normal n, on polygon `own` or on none) at `polygon` of `shooter`, as far down as
  /// what a node's affine function leaves out may bring more than `least` of irradiance. Replaces
  /// `found`, ascending by node; false where too much stands between.
  bool look(const Vec3& p, const Vec3& n, std::uint32_t own, ClusterId shooter,
            const PatchForest& forest, std::uint32_t polygon, double least,
            std::vector<VisibleNode>& found);

 private:
  bool look_at(const Vec3& p, const Vec3& n, const PatchForest& forest, std::size_t node,
               double least, std::vector<VisibleNode>& found);
  void add_part(const Vec3& p, const Vec3& n, const PatchForest& forest, const PatchShape& shape,
                double least, int cuts, VisibleNode& sum);

  const Occluders* occluders_;
  std::vector<std::uint32_t> between_;
  VisibleParts parts_;
  Polygon corners_;
};

/// The one of `nodes` (ascending) that point y of the polygon lies in; null for none.
const VisibleNode* node_around(std::span<const VisibleNode> nodes, const PatchForest& forest,
                               std::uint32_t polygon, const Vec3& y);

}  // namespace enfilade
