#include "final_gather/visible_nodes.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/form_factor.hpp"

namespace enfilade {
namespace {

/// Up to so many are cut away exactly.
constexpr std::size_t most_occluders = 16;
/// How much closer what rays will not mend is looked at.
constexpr double closer = 1.0 / 64.0;
constexpr int most_cuts = 10;

struct Slope {
  Vec2 along{0.0};   ///< of radiosity, a metre; of the band where it matters most
  double rms = 0.0;  ///< by which that varies over the shape
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

bool VisibleNodes::look(const Vec3& p, const Vec3& n, std::uint32_t own, ClusterId shooter,
                        const PatchForest& forest, std::uint32_t polygon, double least,
                        std::vector<VisibleNode>& found) {
  found.clear();
  corners_.clear();
  for (const Vec2& c : forest.node(polygon).shape.vertices) {
    corners_.push_back(forest.frames()[polygon].at(c));
  }
  if (!occluders_->find_between({p}, corners_, own, occluders_->global(shooter, polygon),
                                most_occluders, between_) ||
      !look_at(p, n, forest, polygon, least, found)) {
    found.clear();
    return false;
  }
  std::sort(found.begin(), found.end(),
            [](const VisibleNode& a, const VisibleNode& b) { return a.node < b.node; });
  return true;
}

bool VisibleNodes::look_at(const Vec3& p, const Vec3& n, const PatchForest& forest,
                           std::size_t node, double least, std::vector<VisibleNode>& found) {
  const PatchNode& at = forest.node(node);
  const PolygonFrame& frame = forest.frames()[at.id.root];
  corners_.clear();
  for (const Vec2& c : at.shape.vertices) corners_.push_back(frame.at(c));
  const double whole = point_to_polygon(p, n, corners_);
  if (whole <= 0.0) return true;
  if (!at.leaf() && whole * forest.deviation(node) > least) {
    const auto child = static_cast<std::size_t>(at.first_child);
    return look_at(p, n, forest, child, least, found) &&
           look_at(p, n, forest, child + 1, least, found);
  }
  parts_.begin(p, corners_, occluders_->tolerance_m());
  for (const std::uint32_t occluder : between_) {
    if (!parts_.hide(occluders_->polygon(occluder))) return false;
  }
  VisibleNode seen{static_cast<std::uint32_t>(node)};
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    PatchOutline outline;
    for (const Vec3& corner : parts_[i]) outline.push_back(frame.project(corner));
    add_part(p, n, forest, PatchShape::from(outline), closer * least, most_cuts, seen);
  }
  found.push_back(seen);
  return true;
}

/// Cut across the slope until what that brings, were all of the part at its centroid, is below
/// `least`; then from such a part and its halves to what ever finer ones would come to
/// (Richardson).
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
  if (whole * slope.rms <= 1e-3 * least) return sum.add(whole, shift);
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
