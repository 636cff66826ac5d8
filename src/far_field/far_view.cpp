#include "far_field/far_view.hpp"

#include <algorithm>
#include <cmath>

namespace enfilade {

namespace {

/// Share of a node's power and area in all directions that is added to what faces a point when
/// clusters are drawn.
constexpr double turned_away_share = 0.1;

}  // namespace

Vec2 fold_direction(const Vec3& w) {
  if (w == Vec3(0.0)) return {2.0, 2.0};
  const double sum = std::abs(w.x) + std::abs(w.y) + std::abs(w.z);
  const Vec2 p = Vec2(w.x, w.y) / sum;
  if (w.z >= 0.0) return p;
  return {std::copysign(1.0 - std::abs(p.y), p.x), std::copysign(1.0 - std::abs(p.x), p.y)};
}

Vec3 unfold_direction(const Vec2& folded) {
  if (folded.x > 1.5) return Vec3(0.0);
  Vec3 w(folded.x, folded.y, 1.0 - std::abs(folded.x) - std::abs(folded.y));
  if (w.z < 0.0) {
    w.x = std::copysign(1.0 - std::abs(folded.y), folded.x);
    w.y = std::copysign(1.0 - std::abs(folded.x), folded.y);
  }
  return glm::normalize(w);
}

TreeSight::TreeSight(const BuildingTree& tree, const CellSights& sights, std::vector<CellId> cells)
    : cells_(std::move(cells)) {
  for (const CellId cell : cells_) {
    const std::uint32_t place = tree.place_of(cell);
    if (place != CellId::none_value) places_.push_back(place);
  }
  for (const ClusterId cluster : sights.sticking_out()) {
    if (sees_cluster(sights, cluster))
      places_.push_back(tree.place_of(sights.cells_of(cluster).front()));
  }
  std::sort(places_.begin(), places_.end());
  places_.erase(std::unique(places_.begin(), places_.end()), places_.end());
  places_.shrink_to_fit();  // many clusters had added the same place
}

bool TreeSight::sees_cluster(const CellSights& sights, ClusterId cluster) const {
  const std::span<const CellId> lies_in = sights.cells_of(cluster);
  return std::any_of(lies_in.begin(), lies_in.end(), [this](CellId cell) {
    return std::binary_search(cells_.begin(), cells_.end(), cell);
  });
}

bool TreeSight::may_see(const BuildingTree& tree, const CellSights& sights,
                        std::uint32_t node) const {
  const BuildingTree::Node& n = tree.node(node);
  if (n.leaf()) return sees_cluster(sights, n.cluster);
  const auto first = std::lower_bound(places_.begin(), places_.end(), n.first_cell);
  return first != places_.end() && *first < n.end_cell;
}

std::shared_ptr<const TreeSight> FarField::sight_of(ClusterId receiver) const {
  const std::span<const CellId> lies_in = sights.cells_of(receiver);
  std::shared_ptr<const TreeSight>& sight = sights_[{lies_in.begin(), lies_in.end()}];
  if (!sight) sight = std::make_shared<TreeSight>(tree, sights, sights.seen_by(receiver));
  return sight;
}

/// The probability that a draw goes on to the left child.
double FarView::share_of_left(const BuildingTree::Node& node, const Vec3& x) const {
  const auto sent = [&](std::uint32_t part) {
    const BuildingLight::Draw& draw = light().draw(part);
    const Vec3 d = x - Vec3(draw.center[0], draw.center[1], draw.center[2]);
    const double r2 = glm::dot(d, d);
    double weight = turned_away_share * draw.all;
    if (r2 > draw.size2) {
      const std::array<double, directions> share = axis_shares(d);
      double faces = 0.0;
      for (std::size_t k = 0; k < directions; ++k) faces += share[k] * draw.weight[k];
      weight += faces / std::sqrt(r2);
    } else {
      weight += draw.all;
    }
    return weight / std::max(r2, static_cast<double>(draw.size2));
  };
  const double left = sent(node.left), right = sent(node.right);
  return left + right > 0.0 ? left / (left + right) : 0.5;
}

ClusterId FarView::pick_cluster(std::uint32_t node, const Vec3& x, double& pick,
                                double& probability) const {
  probability = 1.0;
  while (!tree().node(node).leaf()) {
    const BuildingTree::Node& n = tree().node(node);
    const double share = share_of_left(n, x);
    const bool goes_left = pick < share;
    probability *= goes_left ? share : 1.0 - share;
    pick = goes_left ? pick / share : (pick - share) / (1.0 - share);
    node = goes_left ? n.left : n.right;
  }
  pick = std::min(pick, 1.0 - 1e-12);
  return tree().node(node).cluster;
}

double FarView::probability_of(std::uint32_t node, const Vec3& x, ClusterId cluster) const {
  double probability = 1.0;
  while (!tree().node(node).leaf()) {
    const BuildingTree::Node& n = tree().node(node);
    const double share = share_of_left(n, x);
    const bool goes_left = contains(n.left, cluster);
    probability *= goes_left ? share : 1.0 - share;
    node = goes_left ? n.left : n.right;
  }
  return probability;
}

}  // namespace enfilade
