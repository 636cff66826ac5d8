#include "clusters/building_tree.hpp"

#include <algorithm>

namespace enfilade {
namespace {

/// Sorts [begin, end) so that the half with the lower middles along the widest axis of all middles
/// comes first; returns where the other half begins. Ties are broken by `number`.
template <class Iterator, class Middle, class Number>
Iterator halve(Iterator begin, Iterator end, Middle middle, Number number) {
  Box box;
  for (Iterator i = begin; i != end; ++i) box.add(middle(*i));
  const int axis = box.longest_axis();
  const Iterator half = begin + (end - begin) / 2;
  std::nth_element(begin, half, end, [&](const auto& a, const auto& b) {
    const double x = middle(a)[axis], y = middle(b)[axis];
    return x < y || (x == y && number(a) < number(b));
  });
  return half;
}

}  // namespace

struct BuildingTree::Leaf {
  const Cluster* cluster;
};

std::array<double, directions> axis_shares(const Vec3& w) {
  if (w == Vec3(0.0)) return {0.5, 0.5, 0.5, 0.5, 0.5, 0.5};
  return {std::max(0.0, w.x),  std::max(0.0, -w.x), std::max(0.0, w.y),
          std::max(0.0, -w.y), std::max(0.0, w.z),  std::max(0.0, -w.z)};
}

BuildingTree::BuildingTree(std::span<const Cluster> clusters) : leaf_of_(clusters.size(), 0) {
  if (clusters.empty()) return;
  std::size_t cells = 0;
  for (const Cluster& cluster : clusters) cells = std::max(cells, cluster.cell.index() + 1);
  std::vector<std::vector<Leaf>> leaves(cells);
  std::vector<Box> boxes(cells);
  for (const Cluster& cluster : clusters) {
    leaves[cluster.cell.index()].push_back({&cluster});
    boxes[cluster.cell.index()].add(cluster.bounds);
  }
  place_of_.assign(cells, CellId::none_value);
  for (std::size_t c = 0; c < cells; ++c) {
    if (!leaves[c].empty()) cells_.emplace_back(c);
  }
  nodes_.reserve(2 * clusters.size());
  add_cells(0, static_cast<std::uint32_t>(cells_.size()), leaves, boxes);
}

std::uint32_t BuildingTree::add_cells(std::uint32_t first, std::uint32_t end,
                                      std::span<const std::vector<Leaf>> leaves,
                                      std::span<const Box> boxes) {
  if (end - first == 1) {
    const CellId cell = cells_[first];
    place_of_[cell.index()] = first;
    std::vector<Leaf> own = leaves[cell.index()];
    return add_clusters(own, first);
  }
  const auto at = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  const auto half = halve(
      cells_.begin() + first, cells_.begin() + end,
      [&](CellId cell) { return boxes[cell.index()].center(); },
      [](CellId cell) { return cell.value; });
  const auto middle = static_cast<std::uint32_t>(half - cells_.begin());
  const std::uint32_t left = add_cells(first, middle, leaves, boxes);
  return add_parent(at, left, add_cells(middle, end, leaves, boxes));
}

std::uint32_t BuildingTree::add_clusters(std::span<Leaf> leaves, std::uint32_t place) {
  const auto at = static_cast<std::uint32_t>(nodes_.size());
  Node& node = nodes_.emplace_back();
  if (leaves.size() == 1) {
    const Cluster& cluster = *leaves.front().cluster;
    node.bounds = cluster.bounds;
    node.cluster = cluster.id;
    node.begin = static_cast<std::uint32_t>(clusters_.size());
    node.end = node.begin + 1;
    node.first_cell = place;
    node.end_cell = place + 1;
    node.polygons = static_cast<std::uint32_t>(cluster.polygons.size());
    for (const ClusterPolygon& polygon : cluster.polygons) {
      const std::array<double, directions> share = axis_shares(normal(polygon.polygon));
      const double m2 = enfilade::area_m2(polygon.polygon);
      for (std::size_t k = 0; k < directions; ++k) node.facing_m2[k] += m2 * share[k];
    }
    clusters_.push_back(cluster.id);
    leaf_of_[cluster.id.index()] = at;
    return at;
  }
  const auto half = halve(
      leaves.begin(), leaves.end(), [](const Leaf& leaf) { return leaf.cluster->bounds.center(); },
      [](const Leaf& leaf) { return leaf.cluster->id.value; });
  const auto left_size = static_cast<std::size_t>(half - leaves.begin());
  const std::uint32_t left = add_clusters(leaves.first(left_size), place);
  return add_parent(at, left, add_clusters(leaves.subspan(left_size), place));
}

std::uint32_t BuildingTree::add_parent(std::uint32_t at, std::uint32_t left, std::uint32_t right) {
  Node& node = nodes_[at];
  const Node &a = nodes_[left], &b = nodes_[right];
  node.left = left;
  node.right = right;
  node.bounds = a.bounds;
  node.bounds.add(b.bounds);
  node.begin = a.begin;
  node.end = b.end;
  node.first_cell = a.first_cell;
  node.end_cell = b.end_cell;
  node.polygons = a.polygons + b.polygons;
  for (std::size_t k = 0; k < directions; ++k) node.facing_m2[k] = a.facing_m2[k] + b.facing_m2[k];
  return at;
}

double BuildingTree::facing_m2(std::uint32_t node, const Vec3& w) const {
  const std::array<double, directions> share = axis_shares(w);
  double sum = 0.0;
  for (std::size_t k = 0; k < directions; ++k) sum += share[k] * nodes_[node].facing_m2[k];
  return sum;
}

}  // namespace enfilade
