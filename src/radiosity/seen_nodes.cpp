#include "radiosity/seen_nodes.hpp"

#include <algorithm>
#include <cmath>

#include "radiosity/form_factor.hpp"

namespace enfilade {
namespace {

/// Up to so many are cut away exactly.
constexpr std::size_t most_occluders = 16;

}  // namespace

double light_variation(const PatchForest& forest, std::size_t node) {
  const PatchShape& shape = forest.node(node).shape;
  const std::span<const double> light = forest.radiosity(node);
  double square = 0.0;
  for (std::size_t i = 0; forest.terms() == 3 && i < light.size(); i += 3) {
    const double x = light[i + 1], y = light[i + 2];
    square = std::max(square, x * x * shape.cxx + 2.0 * x * y * shape.cxy + y * y * shape.cyy);
  }
  return std::sqrt(std::max(0.0, square) + forest.deviation(node) * forest.deviation(node));
}

bool SeenNodes::look(const Vec3& p, const Vec3& n, std::uint32_t own, ClusterId shooter,
                     const PatchForest& forest, std::uint32_t polygon, double least,
                     std::vector<SeenNode>& found) {
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
            [](const SeenNode& a, const SeenNode& b) { return a.node < b.node; });
  return true;
}

bool SeenNodes::look_at(const Vec3& p, const Vec3& n, const PatchForest& forest, std::size_t node,
                        double least, std::vector<SeenNode>& found) {
  const PatchNode& at = forest.node(node);
  const PolygonFrame& frame = forest.frames()[at.id.root];
  corners_.clear();
  for (const Vec2& c : at.shape.vertices) corners_.push_back(frame.at(c));
  const double whole = point_to_polygon(p, n, corners_);
  if (whole <= 0.0) return true;
  if (!at.leaf() && whole * light_variation(forest, node) > least) {
    const auto child = static_cast<std::size_t>(at.first_child);
    return look_at(p, n, forest, child, least, found) &&
           look_at(p, n, forest, child + 1, least, found);
  }
  parts_.begin(p, corners_, occluders_->tolerance_m());
  for (const std::uint32_t occluder : between_) {
    if (!parts_.hide(occluders_->polygon(occluder))) return false;
  }
  found.push_back({static_cast<std::uint32_t>(node), std::min(whole, parts_.factor(n))});
  return true;
}

const SeenNode* node_around(std::span<const SeenNode> nodes, const PatchForest& forest,
                            std::uint32_t polygon, const Vec3& y) {
  if (nodes.empty()) return nullptr;
  const auto less = [](const SeenNode& a, std::uint32_t node) { return a.node < node; };
  for (auto node = static_cast<std::int32_t>(forest.leaf_at(polygon, y)); node >= 0;
       node = forest.node(static_cast<std::size_t>(node)).parent) {
    const auto number = static_cast<std::uint32_t>(node);
    const auto at = std::lower_bound(nodes.begin(), nodes.end(), number, less);
    if (at != nodes.end() && at->node == number) return &*at;
  }
  return nullptr;
}

}  // namespace enfilade
