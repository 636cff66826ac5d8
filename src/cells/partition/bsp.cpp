// Builds the partition with a stack of jobs: its depth is not bounded by the logarithm of its size.
#include "cells/partition/bsp.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace enfilade {
namespace {

/// The part of a piece that lies in one region.
struct Fragment {
  std::uint32_t plane;
  bool same_facing;
  bool on_border;  ///< lies in the region's border, since its plane has been cut along
  double area;
  Polygon polygon;
};

/// A region that is still to be cut, or to become a leaf.
struct Job {
  std::int32_t node;
  Region region;
  std::vector<Fragment> fragments;  ///< ordered by plane
};

struct Choice {
  bool found = false;
  std::uint32_t plane = 0;
  double share = 0.0, area = 0.0;
  Polygon section;
};

double border_area(const std::vector<Fragment>& fragments) {
  double sum = 0.0;
  for (const Fragment& f : fragments) sum += f.on_border ? f.area : 0.0;
  return sum;
}

/// Shares and areas count as different only where they differ by more than this share of them.
constexpr double share_rounding = 1e-6;

// The plane that covers the largest share of the region's cross-section along it. Each facing is
// summed by itself, because the two faces of a thin wall cover the same ground. In a sprawling
// building no wall covers much of the whole: there a plane counts that is large beside the walls on
// the region's border, which no furniture in a room is.
Choice most_occluding(const Job& job, const PlaneSet& planes, const CellComplex::Config& config,
                      double tolerance) {
  Choice best;
  const auto& all = job.fragments;
  const double least_area = config.min_border_share * border_area(all);
  for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
    double facing[2] = {0.0, 0.0};
    for (end = begin; end < all.size() && all[end].plane == all[begin].plane; ++end) {
      if (!all[end].on_border) facing[all[end].same_facing ? 0 : 1] += all[end].area;
    }
    const double area = std::max(facing[0], facing[1]);
    if (area <= 0.0) continue;
    Polygon section = cross_section(job.region, planes.planes[all[begin].plane]);
    const double whole = area_m2(section);
    if (whole <= tolerance * tolerance) continue;
    const double share = std::min(1.0, area / whole);
    if (share < config.min_occlusion && area < least_area) continue;
    const bool clearly = share > best.share * (1.0 + share_rounding);
    const bool level = !clearly && share >= best.share * (1.0 - share_rounding);
    if (clearly || (level && area > best.area * (1.0 + share_rounding))) {
      best = {true, all[begin].plane, share, area, std::move(section)};
    }
  }
  return best;
}

struct Sides {
  std::vector<Fragment> front, behind;
  std::vector<InPlane> in_plane;
};

void add_part(const Fragment& like, Polygon polygon, std::vector<Fragment>& list) {
  const double area = area_m2(polygon);
  if (polygon.size() >= 3 && area > 0.0) {
    list.push_back({like.plane, like.same_facing, like.on_border, area, std::move(polygon)});
  }
}

/// Sorts the fragments of a region to the two sides of a plane that cuts it.
Sides sort_to_sides(std::vector<Fragment>& fragments, std::uint32_t plane_index,
                    const PlaneSet& planes, double tolerance) {
  Sides sides;
  const Plane& plane = planes.planes[plane_index];
  for (Fragment& fragment : fragments) {
    const DistanceRange range = distances(fragment.polygon, plane);
    const bool any_front = range.highest > tolerance, any_behind = range.lowest < -tolerance;
    if (fragment.plane == plane_index || (!any_front && !any_behind)) {
      const Vec3& n = planes.planes[fragment.plane].n;
      const bool same = fragment.same_facing == (glm::dot(n, plane.n) >= 0.0);
      // It stays, as a part of the border, on the side that its front faces.
      auto& list = same ? sides.front : sides.behind;
      list.push_back({fragment.plane, fragment.same_facing, true, fragment.area, fragment.polygon});
      if (fragment.on_border) continue;
      const Box box = bounds(fragment.polygon);
      sides.in_plane.push_back({std::move(fragment.polygon), box, same});
    } else if (!any_behind) {
      sides.front.push_back(std::move(fragment));
    } else if (!any_front) {
      sides.behind.push_back(std::move(fragment));
    } else {
      auto [front, behind] = split(fragment.polygon, plane, tolerance);
      add_part(fragment, std::move(front), sides.front);
      add_part(fragment, std::move(behind), sides.behind);
    }
  }
  return sides;
}

std::vector<Fragment> all_fragments(std::span<const Piece> pieces, const PlaneSet& planes) {
  std::vector<std::size_t> order(pieces.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return planes.plane_of_piece[a] < planes.plane_of_piece[b];
  });
  std::vector<Fragment> fragments;
  for (const std::size_t i : order) {
    fragments.push_back({planes.plane_of_piece[i], planes.same_facing[i] != 0, false,
                         area_m2(pieces[i].polygon), pieces[i].polygon});
  }
  return fragments;
}

}  // namespace

BspTree build_bsp(std::span<const Piece> pieces, const PlaneSet& planes, Region region,
                  const CellComplex::Config& config, double tolerance_m) {
  BspTree tree;
  tree.nodes.emplace_back();
  std::vector<Job> jobs;
  jobs.push_back({0, std::move(region), all_fragments(pieces, planes)});
  while (!jobs.empty()) {
    Job job = std::move(jobs.back());
    jobs.pop_back();
    Choice choice;
    if (tree.leaves.size() + jobs.size() + 2 <= config.max_leaves) {
      choice = most_occluding(job, planes, config, tolerance_m);
    }
    BspNode& node = tree.nodes[static_cast<std::size_t>(job.node)];
    if (!choice.found) {
      node.cell = CellId(tree.leaves.size());
      tree.leaves.push_back(std::move(job.region));
      continue;
    }
    node.plane = planes.planes[choice.plane];
    node.front = static_cast<std::int32_t>(tree.nodes.size());
    node.back = node.front + 1;
    Sides sides = sort_to_sides(job.fragments, choice.plane, planes, tolerance_m);
    auto [front, behind] = split_region(job.region, node.plane, choice.section);
    jobs.push_back({node.back, std::move(behind), std::move(sides.behind)});
    jobs.push_back({node.front, std::move(front), std::move(sides.front)});
    tree.cuts.push_back(
        {job.node, choice.plane, std::move(choice.section), std::move(sides.in_plane)});
    tree.nodes.resize(tree.nodes.size() + 2);
  }
  return tree;
}

void cut_leaves(BspTree& tree, std::span<const LeafAcross> cuts, std::span<const Piece> pieces,
                const PlaneSet& planes, double tolerance_m) {
  std::map<std::uint32_t, std::vector<InPlane>> pieces_in;  // planes that cut
  for (const LeafAcross& cut : cuts) pieces_in.try_emplace(cut.plane);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const auto at = pieces_in.find(planes.plane_of_piece[i]);
    if (at == pieces_in.end()) continue;
    const Polygon& polygon = pieces[i].polygon;
    at->second.push_back({polygon, bounds(polygon), planes.same_facing[i] != 0});
  }
  std::vector<std::int32_t> node_of_leaf(tree.leaves.size());
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const BspNode& node = tree.nodes[i];
    if (node.front < 0) node_of_leaf[node.cell.index()] = static_cast<std::int32_t>(i);
  }
  std::map<std::uint32_t, std::vector<std::uint32_t>> parts_of;  // of leaves that were cut
  for (const LeafAcross& cut : cuts) {
    std::vector<std::uint32_t>& parts = parts_of.try_emplace(cut.leaf, 1, cut.leaf).first->second;
    const Plane& plane = planes.planes[cut.plane];
    for (std::size_t i = 0, count = parts.size(); i < count; ++i) {
      const std::uint32_t leaf = parts[i];
      const DistanceRange range = distances(tree.leaves[leaf], plane);
      if (range.highest <= tolerance_m || range.lowest >= -tolerance_m) continue;
      Polygon section = cross_section(tree.leaves[leaf], plane);
      if (section.size() < 3 || area_m2(section) <= tolerance_m * tolerance_m) continue;
      std::vector<InPlane> covers;
      for (const InPlane& piece : pieces_in.at(cut.plane)) {
        if (piece.box.overlaps(bounds(section), tolerance_m)) covers.push_back(piece);
      }
      const auto added = static_cast<std::uint32_t>(tree.leaves.size());
      auto [front, behind] = split_region(tree.leaves[leaf], plane, section);
      tree.leaves[leaf] = std::move(behind);
      tree.leaves.push_back(std::move(front));
      const std::int32_t at = node_of_leaf[leaf];
      const auto child = static_cast<std::int32_t>(tree.nodes.size());
      tree.nodes.resize(tree.nodes.size() + 2);
      tree.nodes[static_cast<std::size_t>(at)] = {plane, child, child + 1, CellId()};
      tree.nodes[static_cast<std::size_t>(child)].cell = CellId(added);
      tree.nodes[static_cast<std::size_t>(child) + 1].cell = CellId(leaf);
      node_of_leaf.push_back(child);
      node_of_leaf[leaf] = child + 1;
      tree.cuts.push_back({at, cut.plane, std::move(section), std::move(covers)});
      parts.push_back(added);
    }
  }
}

}  // namespace enfilade
