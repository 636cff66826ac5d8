// Which clusters may matter to the points of the error samples.
#include <algorithm>
#include <numbers>

#include "gather/error_samples.hpp"

namespace enfilade {

std::vector<ClusterId> ErrorSamples::shooters(const FarView& far) const {
  std::vector<ClusterId> found;
  for (const Hit& hit : hits_) {
    if (found.empty() || found.back() != hit.polygon.cluster) found.push_back(hit.polygon.cluster);
  }
  for (const Point& point : points_) add_shooters(far, point, found);
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

/// Follows the tree of the building down to the clusters of which a polygon may bring more than the
/// least share that counts, by distance and size alone.
void ErrorSamples::add_shooters(const FarView& far, const Point& point,
                                std::vector<ClusterId>& found) const {
  const Box here{point.x, point.x};
  std::vector<std::uint32_t> open{BuildingTree::root};
  while (!open.empty()) {
    const std::uint32_t at = open.back();
    open.pop_back();
    const BuildingTree::Node& node = far.tree().node(at);
    const double most = far.light().most(at);
    if (most <= 0.0 || !far.may_see(at)) continue;
    if (highest_distance(node.bounds, {point.n, glm::dot(point.n, point.x)}) <= 0.0) continue;
    double m2 = 0.0;
    for (const double facing : node.facing_m2) m2 += facing;
    const double gap = gap_m(node.bounds, here);
    const double factor = gap > 0.0 ? std::min(1.0, m2 / (std::numbers::pi * gap * gap)) : 1.0;
    const double least = most > bright_radiosity(point) ? least_bright_share : least_share;
    if (most * factor <= least * reference_irradiance(point)) continue;
    if (node.leaf()) {
      found.push_back(node.cluster);
    } else {
      open.push_back(node.left);
      open.push_back(node.right);
    }
  }
}

}  // namespace enfilade
