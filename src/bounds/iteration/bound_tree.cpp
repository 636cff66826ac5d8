#include "bounds/iteration/bound_tree.hpp"

#include <algorithm>
#include <numeric>

namespace enfilade {

BoundTree::BoundTree(std::span<const Polygon> polygons) : polygon_nodes_(polygons.size()) {
  std::vector<std::uint32_t> all(polygons.size());
  std::iota(all.begin(), all.end(), 0u);
  nodes_.emplace_back();
  if (!all.empty()) build(polygons, 0, all);
}

void BoundTree::build(std::span<const Polygon> polygons, std::uint32_t node,
                      std::span<std::uint32_t> among) {
  Box box, centers;
  for (const std::uint32_t k : among) {
    box.add(bounds(polygons[k]));
    centers.add(bounds(polygons[k]).center());
  }
  nodes_[node].box = box;
  if (among.size() == 1) {
    nodes_[node].polygon = among[0];
    nodes_[node].shape = FlatShape(polygons[among[0]], plane_of(polygons[among[0]]));
    nodes_[node].area_m2 = nodes_[node].shape.area_m2;
    polygon_nodes_[among[0]] = node;
    return;
  }
  const int axis = centers.longest_axis();
  const auto middle = among.begin() + static_cast<std::ptrdiff_t>(among.size() / 2);
  std::nth_element(among.begin(), middle, among.end(), [&](std::uint32_t i, std::uint32_t j) {
    const double ci = bounds(polygons[i]).center()[axis], cj = bounds(polygons[j]).center()[axis];
    return ci != cj ? ci < cj : i < j;
  });
  const auto first = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node].first_child = first;
  for (int i = 0; i < 2; ++i) nodes_.emplace_back().parent = node;
  build(polygons, first, among.first(among.size() / 2));
  build(polygons, first + 1, among.subspan(among.size() / 2));
  nodes_[node].area_m2 = nodes_[first].area_m2 + nodes_[first + 1].area_m2;
}

std::uint32_t BoundTree::split(std::uint32_t leaf) {
  const auto first = static_cast<std::uint32_t>(nodes_.size());
  auto [a, b] = halves(nodes_[leaf].shape);
  for (FlatShape* half : {&a, &b}) {
    BoundNode node;
    node.parent = leaf;
    node.polygon = nodes_[leaf].polygon;
    node.box = bounds(half->polygon);
    node.area_m2 = half->area_m2;
    node.shape = std::move(*half);
    nodes_.push_back(std::move(node));
  }
  nodes_[leaf].first_child = first;
  return first;
}

}  // namespace enfilade
