// Each cut's cross-section is pushed down both subtrees, and its covering polygons are cut out.
#include "cells/partition/interface.hpp"

#include <algorithm>
#include <functional>
#include <utility>

namespace enfilade {
namespace {

using LeafPart = std::pair<std::uint32_t, Polygon>;

// The parts of a polygon by the leaf of the subtree that they bound.
std::vector<LeafPart> push_to_leaves(const BspTree& tree, std::int32_t root, Polygon polygon,
                                     double tolerance) {
  std::vector<LeafPart> parts;
  std::vector<std::pair<std::int32_t, Polygon>> jobs;
  jobs.emplace_back(root, std::move(polygon));
  while (!jobs.empty()) {
    auto [at, part] = std::move(jobs.back());
    jobs.pop_back();
    const BspNode& node = tree.nodes[static_cast<std::size_t>(at)];
    if (node.front < 0) {
      parts.emplace_back(node.cell.value, std::move(part));
      continue;
    }
    const DistanceRange range = distances(part, node.plane);
    if (range.lowest >= -tolerance || range.highest <= tolerance) {
      jobs.emplace_back(range.sum >= 0.0 ? node.front : node.back, std::move(part));
      continue;
    }
    auto [front, behind] = split(part, node.plane, tolerance);
    if (behind.size() >= 3) jobs.emplace_back(node.back, std::move(behind));
    if (front.size() >= 3) jobs.emplace_back(node.front, std::move(front));
  }
  return parts;
}

bool is_sliver(const Polygon& polygon, double sliver_m) {
  return polygon.size() < 3 || area_m2(polygon) <= sliver_m * diameter(polygon);
}

// Openings with their boxes: each of many covers meets few of many openings.
struct OpenPart {
  Polygon polygon;
  Box box;
};

// Cuts the covering polygons of one facing away from `openings`; returns the area that they cover.
double cover(std::vector<Polygon>& openings, const std::vector<const InPlane*>& covers, bool facing,
             double sliver_m) {
  const auto covers_it = [facing](const InPlane* c) { return c->same_facing == facing; };
  if (std::none_of(covers.begin(), covers.end(), covers_it)) return 0.0;
  const double before = total_area_m2(openings);
  std::vector<OpenPart> left;
  for (Polygon& opening : openings) {
    const Box box = bounds(opening);
    left.push_back({std::move(opening), box});
  }
  for (const InPlane* in_plane : covers) {
    if (in_plane->same_facing != facing) continue;
    std::vector<OpenPart> next;
    for (OpenPart& opening : left) {
      if (!opening.box.overlaps(in_plane->box, sliver_m)) {
        next.push_back(std::move(opening));
        continue;
      }
      for (Polygon& part : subtract_coplanar(opening.polygon, in_plane->polygon, 1e-3 * sliver_m)) {
        if (is_sliver(part, sliver_m)) continue;
        const Box box = bounds(part);
        next.push_back({std::move(part), box});
      }
    }
    left = std::move(next);
  }
  openings.clear();
  for (OpenPart& opening : left) openings.push_back(std::move(opening.polygon));
  return before - total_area_m2(openings);
}

}  // namespace

double total_area_m2(const std::vector<Polygon>& polygons) {
  double sum = 0.0;
  for (const Polygon& polygon : polygons) sum += area_m2(polygon);
  return sum;
}

std::vector<LeafInterface> find_interfaces(const BspTree& tree, double sliver_m) {
  std::vector<LeafInterface> all;
  const double fine = 1e-3 * sliver_m;
  std::vector<const InPlane*> near;
  for (std::uint32_t number = 0; number < tree.cuts.size(); ++number) {
    const BspCut& cut = tree.cuts[number];
    const BspNode& node = tree.nodes[static_cast<std::size_t>(cut.node)];
    for (auto& [front_leaf, on_front] : push_to_leaves(tree, node.front, cut.section, fine)) {
      for (auto& [back_leaf, common] : push_to_leaves(tree, node.back, std::move(on_front), fine)) {
        LeafInterface face;
        face.area_m2 = area_m2(common);
        if (face.area_m2 <= sliver_m * diameter(common)) continue;
        face.front_leaf = front_leaf;
        face.back_leaf = back_leaf;
        face.plane = cut.plane;
        face.cut = number;
        face.n = node.plane.n;
        const Box box = bounds(common);
        near.clear();
        for (const InPlane& in_plane : cut.covered_by) {
          if (in_plane.box.overlaps(box, sliver_m)) near.push_back(&in_plane);
        }
        // One facing at a time for the area that each side sees; then both, for the openings.
        face.openings.push_back(common);
        face.faces_front_m2 = cover(face.openings, near, true, sliver_m);
        std::vector<Polygon> rest;
        rest.push_back(std::move(common));
        face.faces_back_m2 = cover(rest, near, false, sliver_m);
        cover(face.openings, near, false, sliver_m);
        face.open_m2 = total_area_m2(face.openings);
        all.push_back(std::move(face));
      }
    }
  }
  return all;
}

}  // namespace enfilade
