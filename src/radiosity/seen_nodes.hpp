// What a point sees of a polygon past what few others hide, in closed form: as fine as its light
// varies.
#pragma once

#include <vector>

#include "radiosity/cluster_state.hpp"
#include "radiosity/occluders.hpp"
#include "radiosity/visible_parts.hpp"

namespace enfilade {

/// A node of the polygon's hierarchy and its visible form factor. Nodes cover what is in view of
/// the polygon, each once.
struct SeenNode {
  std::uint32_t node;
  double factor;
};

/// RMS by which the radiosity varies over a node around its mean, worst band.
double light_variation(const PatchForest& forest, std::size_t node);

/// Looks from points at polygons; keeps scratch memory between calls.
class SeenNodes {
 public:
  explicit SeenNodes(const Occluders& occluders) : occluders_(&occluders) {}

  /// From p (unit normal n, on polygon `own` or on none) at `polygon` of `shooter`, as far down as
  /// what a node's mean leaves out may bring more than `least` of irradiance. Replaces `found`,
  /// ascending by node; false where too much stands between.
  bool look(const Vec3& p, const Vec3& n, std::uint32_t own, ClusterId shooter,
            const PatchForest& forest, std::uint32_t polygon, double least,
            std::vector<SeenNode>& found);

 private:
  bool look_at(const Vec3& p, const Vec3& n, const PatchForest& forest, std::size_t node,
               double least, std::vector<SeenNode>& found);

  const Occluders* occluders_;
  std::vector<std::uint32_t> between_;
  VisibleParts parts_;
  Polygon corners_;
};

/// The one of `nodes` (ascending) that point y of the polygon lies in; null for none.
const SeenNode* node_around(std::span<const SeenNode> nodes, const PatchForest& forest,
                            std::uint32_t polygon, const Vec3& y);

}  // namespace enfilade
