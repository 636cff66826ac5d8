#include "final_gather/visible_nodes.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/form_factor.hpp"

namespace enfilade {
namespace {

/// Up to so many occluders are cut out of the polygon exactly.
constexpr std::size_t most_occluders = 16;
/// Of `least`: how much irradiance the slope of a visible part may be wrong by. No rays correct
/// this error, as they correct the deviation from the affine function.
constexpr double cut_tolerance = 1.0 / 64.0;
constexpr int most_cuts = 10;  ///< of a visible part
/// Share of that error below which a part is taken as a whole, without extrapolation.
constexpr double negligible = 1e-3;

struct Slope {
  Vec2 along{0.0};   ///< gradient of radiosity per metre, of the band where it varies most
  double rms = 0.0;  ///< RMS variation over the shape by this gradient
};

Slope slope_over(const PatchForest& forest, std::size_t node, const PatchShape& shape) {
  Slope most;
  const std::span<const double> light = forest.radiosity(node);
  for (std::size_t i = 0; forest.terms() == 3 && i < light.size(); i += 3) {
    const double x = light[i + 1], y = light[i + 2];
    const double square = x * x * shape.cxx + 2.0 * x * y * shape.cxy + y * y * shape.cyy;
    if (square > most.rms * most.rms) most = {{x, y}, std::sqrt(square)};
  }
  return most;
}

}  // namespace

Polygon corners_of(const PolygonFrame& frame, const PatchShape& shape) {
  Polygon corners;
  for (const Vec2& c : shape.vertices) corners.push_back(frame.at(c));
  return corners;
}

bool VisibleNodes::find(const Vec3& p, const Vec3& n, std::uint32_t own, ClusterId shooter,
                        const PatchForest& forest, std::uint32_t polygon, double least,
                        std::vector<VisibleNode>& found) {
  found.clear();
  corners_.clear();
  for (const Vec2& c : forest.node(polygon).shape.vertices) {
    corners_.push_back(forest.frames()[polygon].at(c));
  }
  if (!occluders_->find_between({p}, corners_, own, occluders_->global(shooter, polygon),
                                most_occluders, between_) ||
      !find_below(p, n, forest, polygon, least, found)) {
    found.clear();
    return false;
  }
  std::sort(found.begin(), found.end(),
            [](const VisibleNode& a, const VisibleNode& b) { return a.node < b.node; });
  return true;
}

bool VisibleNodes::find_below(const Vec3& p, const Vec3& n, const PatchForest& forest,
                              std::size_t node, double least, std::vector<VisibleNode>& found) {
  const PatchNode& at = forest.node(node);
  const PolygonFrame& frame = forest.frames()[at.id.root];
  corners_.clear();
  for (const Vec2& c : at.shape.vertices) corners_.push_back(frame.at(c));
  const double whole = point_to_polygon(p, n, corners_);
  if (whole <= 0.0) return true;
  if (!at.leaf() && whole * forest.deviation(node) > least) {
    const auto child = static_cast<std::size_t>(at.first_child);
    return find_below(p, n, forest, child, least, found) &&
           find_below(p, n, forest, child + 1, least, found);
  }
  parts_.begin(p, corners_, occluders_->tolerance_m());
  for (const std::uint32_t occluder : between_) {
    if (!parts_.hide(occluders_->polygon(occluder))) return false;
  }
  VisibleNode visible{static_cast<std::uint32_t>(node)};
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    PatchOutline outline;
    for (const Vec3& corner : parts_[i]) outline.push_back(frame.project(corner));
    add_part(p, n, forest, PatchShape::from(outline), cut_tolerance * least, most_cuts, visible);
  }
  found.push_back(visible);
  return true;
}

/// Adds a visible part's factor and first moment. A part counts as a point at its centroid; it is
/// cut across the slope until its factor times the slope's variation is below `least`. The moments
/// of such a part and of its halves are extrapolated to those of ever smaller ones (Richardson).
void VisibleNodes::add_part(const Vec3& p, const Vec3& n, const PatchForest& forest,
                            const PatchShape& shape, double least, int cuts, VisibleNode& sum) {
  const PatchNode& at = forest.node(sum.node);
  const PolygonFrame& frame = forest.frames()[at.id.root];
  const auto factor = [&](const PatchShape& part) {
    corners_.clear();
    for (const Vec2& c : part.vertices) corners_.push_back(frame.at(c));
    return point_to_polygon(p, n, corners_);
  };
  const double whole = factor(shape);
  if (whole <= 0.0) return;
  const Slope slope = slope_over(forest, sum.node, shape);
  const Vec2 shift = shape.centroid - at.shape.centroid;
  if (whole * slope.rms <= negligible * least) return sum.add(whole, shift);
  const Vec2 axis = glm::normalize(slope.along);
  const auto [below, above] = shape.halves({axis, glm::dot(axis, shape.centroid)});
  if (whole * slope.rms > least && cuts > 0) {
    add_part(p, n, forest, below, least, cuts - 1, sum);
    add_part(p, n, forest, above, least, cuts - 1, sum);
    return;
  }
  sum.add(whole, shift);
  sum.moment += 4.0 / 3.0 *
                (factor(below) * (below.centroid - shape.centroid) +
                 factor(above) * (above.centroid - shape.centroid));
}

const VisibleNode* node_around(std::span<const VisibleNode> nodes, const PatchForest& forest,
                               std::uint32_t polygon, const Vec3& y) {
  if (nodes.empty()) return nullptr;
  const auto less = [](const VisibleNode& a, std::uint32_t node) { return a.node < node; };
  for (auto node = static_cast<std::int32_t>(forest.leaf_at(polygon, y)); node >= 0;
       node = forest.node(static_cast<std::size_t>(node)).parent) {
    const auto number = static_cast<std::uint32_t>(node);
    const auto at = std::lower_bound(nodes.begin(), nodes.end(), number, less);
    if (at != nodes.end() && at->node == number) return &*at;
  }
  return nullptr;
}

}  // namespace enfilade
