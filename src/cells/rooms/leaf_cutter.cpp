// Splitting a leaf: its region, its node, its interfaces, and the new face between the two parts.
#include "cells/rooms/leaf_cutter.hpp"

#include <algorithm>
#include <cmath>

namespace enfilade {
LeafCutter::LeafCutter(CutSpace& space)
    : space_(space),
      node_of_leaf_(space.tree.leaves.size()),
      leaves_of_group_(space.groups.kinds.size()),
      by_leaf_(space.tree.leaves.size()),
      pieces_of_plane_(space.planes.planes.size()) {
  for (std::size_t i = 0; i < space.tree.nodes.size(); ++i) {
    const BspNode& node = space.tree.nodes[i];
    if (node.front < 0) node_of_leaf_[node.cell.index()] = static_cast<std::int32_t>(i);
  }
  for (std::uint32_t leaf = 0; leaf < space.groups.group_of_leaf.size(); ++leaf) {
    leaves_of_group_[space.groups.group_of_leaf[leaf]].push_back(leaf);
  }
  for (std::uint32_t i = 0; i < space.interfaces.size(); ++i) {
    by_leaf_[space.interfaces[i].front_leaf].push_back(i);
    by_leaf_[space.interfaces[i].back_leaf].push_back(i);
  }
  for (std::uint32_t i = 0; i < space.pieces.size(); ++i) {
    pieces_of_plane_[space.planes.plane_of_piece[i]].push_back(i);
  }
}

std::uint32_t LeafCutter::leaf_at(const Vec3& p) const {
  const auto& nodes = space_.tree.nodes;
  std::size_t at = 0;
  while (nodes[at].front >= 0) {
    const bool in_front = nodes[at].plane.signed_distance(p) >= 0.0;
    at = static_cast<std::size_t>(in_front ? nodes[at].front : nodes[at].back);
  }
  return nodes[at].cell.value;
}

void LeafCutter::assign(std::uint32_t leaf, std::uint32_t group) {
  std::uint32_t& now = space_.groups.group_of_leaf[leaf];
  std::erase(leaves_of_group_[now], leaf);
  auto& there = leaves_of_group_[group];
  there.insert(std::upper_bound(there.begin(), there.end(), leaf), leaf);
  now = group;
}

std::uint32_t LeafCutter::number_of(const Plane& plane) {
  const auto& planes = space_.planes.planes;
  for (std::uint32_t i = 0; i < planes.size(); ++i) {
    const double cosine = glm::dot(planes[i].n, plane.n);
    const double offset = planes[i].d - (cosine > 0.0 ? plane.d : -plane.d);
    if (std::abs(cosine) > 1.0 - 1e-9 && std::abs(offset) <= space_.tolerance_m) return i;
  }
  space_.planes.planes.push_back(plane);
  pieces_of_plane_.emplace_back();
  return static_cast<std::uint32_t>(space_.planes.planes.size() - 1);
}

std::uint32_t LeafCutter::new_group(std::uint32_t like) {
  space_.groups.kinds.push_back(space_.groups.kinds[like]);
  leaves_of_group_.emplace_back();
  return static_cast<std::uint32_t>(space_.groups.kinds.size() - 1);
}

LeafCutter::Split LeafCutter::cut(std::uint32_t leaf, std::uint32_t plane_number) {
  BspTree& tree = space_.tree;
  const Plane plane = space_.planes.planes[plane_number];
  const DistanceRange range = distances(tree.leaves[leaf], plane);
  if (range.highest <= space_.tolerance_m) return {false, leaf, leaf};
  if (range.lowest >= -space_.tolerance_m) return {false, leaf, leaf};
  BspCut made{node_of_leaf_[leaf], plane_number, cross_section(tree.leaves[leaf], plane), {}};
  if (area_m2(made.section) <= space_.tolerance_m * space_.tolerance_m) return {false, leaf, leaf};
  for (const std::uint32_t i : pieces_of_plane_[plane_number]) {
    const Box box = bounds(space_.pieces[i].polygon);
    if (!box.overlaps(bounds(made.section), space_.tolerance_m)) continue;
    made.covered_by.push_back({space_.pieces[i].polygon, box, space_.planes.same_facing[i] != 0});
  }
  auto [front_region, back_region] = split_region(tree.leaves[leaf], plane, made.section);
  const auto front = static_cast<std::uint32_t>(tree.leaves.size());
  tree.leaves[leaf] = std::move(back_region);
  tree.leaves.push_back(std::move(front_region));
  space_.groups.group_of_leaf.push_back(space_.groups.group_of_leaf[leaf]);
  leaves_of_group_[space_.groups.group_of_leaf[leaf]].push_back(front);
  by_leaf_.emplace_back();

  BspNode& node = tree.nodes[static_cast<std::size_t>(node_of_leaf_[leaf])];
  node.plane = plane;
  node.cell = CellId();
  node.front = static_cast<std::int32_t>(tree.nodes.size());
  node.back = node.front + 1;
  node_of_leaf_.push_back(node.front);
  node_of_leaf_[leaf] = node.back;
  tree.nodes.resize(tree.nodes.size() + 2);
  tree.nodes[tree.nodes.size() - 2].cell = CellId(front);
  tree.nodes[tree.nodes.size() - 1].cell = CellId(leaf);

  split_interfaces(leaf, front, plane_number);
  LeafInterface face;
  face.front_leaf = front;
  face.back_leaf = leaf;
  face.plane = plane_number;
  face.cut = static_cast<std::uint32_t>(tree.cuts.size());
  face.n = plane.n;
  face.area_m2 = area_m2(made.section);
  face.openings = open_parts(made);
  face.open_m2 = total_area_m2(face.openings);
  add_interface(std::move(face));
  tree.cuts.push_back(std::move(made));
  return {true, front, leaf};
}

std::vector<Polygon> LeafCutter::open_parts(const BspCut& cut) const {
  const double sliver_m = 0.01 * space_.tolerance_m;
  std::vector<Polygon> openings{cut.section};
  for (const InPlane& cover : cut.covered_by) {
    std::vector<Polygon> left;
    for (const Polygon& opening : openings) {
      for (Polygon& part : subtract_coplanar(opening, cover.polygon, 1e-3 * sliver_m)) {
        if (part.size() >= 3 && area_m2(part) > sliver_m * diameter(part)) {
          left.push_back(std::move(part));
        }
      }
    }
    openings = std::move(left);
  }
  return openings;
}

void LeafCutter::add_interface(LeafInterface face) {
  const auto number = static_cast<std::uint32_t>(space_.interfaces.size());
  by_leaf_[face.front_leaf].push_back(number);
  by_leaf_[face.back_leaf].push_back(number);
  space_.interfaces.push_back(std::move(face));
}

// Each opening of the leaf goes to the part behind, to the part in front, or is split between them.
void LeafCutter::split_interfaces(std::uint32_t leaf, std::uint32_t front,
                                  std::uint32_t plane_number) {
  const Plane plane = space_.planes.planes[plane_number];
  const std::vector<std::uint32_t> old = std::move(by_leaf_[leaf]);
  by_leaf_[leaf].clear();
  for (const std::uint32_t number : old) {
    LeafInterface before = space_.interfaces[number];
    before.openings.clear();
    LeafInterface behind = before;
    for (const Polygon& opening : space_.interfaces[number].openings) {
      auto [in_front, in_back] = split(opening, plane, 1e-5 * space_.tolerance_m);
      if (in_front.size() >= 3) before.openings.push_back(std::move(in_front));
      if (in_back.size() >= 3) behind.openings.push_back(std::move(in_back));
    }
    const double framed_share = before.open_m2 > 0.0 ? before.framed_m2 / before.open_m2 : 0.0;
    for (LeafInterface* half : {&before, &behind}) {
      half->open_m2 = total_area_m2(half->openings);
      half->framed_m2 = framed_share * half->open_m2;
    }
    (before.front_leaf == leaf ? before.front_leaf : before.back_leaf) = front;
    space_.interfaces[number] = std::move(behind);
    by_leaf_[leaf].push_back(number);
    if (before.openings.empty()) continue;
    add_interface(std::move(before));
  }
}

}  // namespace enfilade
