#include "cells/partition/portal_build.hpp"

#include <map>
#include <tuple>

namespace enfilade {
namespace {

// Joins polygons whose boxes touch into hulls until no two touch.
std::vector<Polygon> hulls(std::vector<Polygon> parts, const Vec3& n, double joint_m) {
  bool changed = true;
  while (changed) {
    changed = false;
    std::vector<Polygon> joined;
    std::vector<Box> boxes;
    for (Polygon& part : parts) {
      const Box box = bounds(part);
      std::size_t i = 0;
      while (i < joined.size() && !boxes[i].overlaps(box, joint_m)) ++i;
      if (i == joined.size()) {
        joined.push_back(std::move(part));
        boxes.push_back(box);
        continue;
      }
      joined[i].insert(joined[i].end(), part.begin(), part.end());
      boxes[i].add(box);
      changed = true;
    }
    for (Polygon& polygon : joined) polygon = convex_hull(std::move(polygon), n);
    parts = std::move(joined);
  }
  return parts;
}

}  // namespace

std::vector<Portal> build_portals(std::span<const LeafInterface> interfaces,
                                  std::span<const std::uint32_t> cell_of_leaf,
                                  std::span<const Plane> planes, double joint_m) {
  using Key =
      std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>;  // cell in front, behind, plane
  std::map<Key, std::vector<Polygon>> openings;
  for (const LeafInterface& face : interfaces) {
    const std::uint32_t a = cell_of_leaf[face.front_leaf], b = cell_of_leaf[face.back_leaf];
    if (a == b || face.openings.empty()) continue;
    auto& list = openings[{a, b, face.plane}];
    list.insert(list.end(), face.openings.begin(), face.openings.end());
  }
  std::vector<Portal> portals;
  for (auto& [key, parts] : openings) {
    const auto& [a, b, plane] = key;
    for (Polygon& polygon : hulls(std::move(parts), planes[plane].n, joint_m)) {
      if (polygon.size() < 3) continue;
      portals.push_back({PortalId(portals.size()), CellId(a), CellId(b), std::move(polygon)});
    }
  }
  return portals;
}

}  // namespace enfilade
