#include "cells/rooms/leak_paths.hpp"

#include <algorithm>
#include <map>
#include <queue>

namespace enfilade {

Vec3 middle_of(const Region& region) {
  Vec3 sum(0.0);
  double count = 0.0;
  for (const Facet& facet : region.facets) {
    for (const Vec3& p : facet.polygon) {
      sum += p;
      count += 1.0;
    }
  }
  return sum / std::max(count, 1.0);
}

/// Adds the openings passed and then the middle of the last leaf on the shortest way (in leaves)
/// within the group, found breadth-first.
template <class IsGoal>
void LeakPaths::add_way(std::uint32_t from, IsGoal is_goal, std::vector<Vec3>& path) const {
  const std::uint32_t group = space_.groups.group_of_leaf[from];
  std::map<std::uint32_t, std::pair<std::uint32_t, Vec3>> came;  // leaf: from where, through what
  std::queue<std::uint32_t> queue;
  queue.push(from);
  came[from] = {from, Vec3(0.0)};
  for (; !queue.empty(); queue.pop()) {
    const std::uint32_t leaf = queue.front();
    if (is_goal(leaf)) {
      std::vector<Vec3> back{middle_of(space_.tree.leaves[leaf])};
      for (std::uint32_t at = leaf; at != from; at = came[at].first) {
        back.push_back(came[at].second);
      }
      path.insert(path.end(), back.rbegin(), back.rend());
      return;
    }
    for (const std::uint32_t i : cutter_.interfaces_of(leaf)) {
      const LeafInterface& face = space_.interfaces[i];
      const std::uint32_t other = face.other_than(leaf);
      if (face.openings.empty() || space_.groups.group_of_leaf[other] != group) continue;
      const auto widest = std::max_element(
          face.openings.begin(), face.openings.end(),
          [](const Polygon& a, const Polygon& b) { return area_m2(a) < area_m2(b); });
      if (came.try_emplace(other, leaf, centroid(*widest)).second) queue.push(other);
    }
  }
}

void LeakPaths::add_way_out(std::uint32_t leaf, std::vector<Vec3>& path) const {
  const auto at_border = [&](std::uint32_t at) { return touches_border_[at] != 0; };
  add_way(leaf, at_border, path);
}

std::vector<Vec3> LeakPaths::through(const Portal& portal, const Vec3& gap, CellId room) const {
  const Vec3 n = normal(portal.polygon);
  const double near_m = 4.0 * space_.tolerance_m * (portal.a == room ? 1.0 : -1.0);
  const std::uint32_t inner = cutter_.leaf_at(gap + near_m * n);
  std::uint32_t largest = inner;
  double most = 0.0;
  for (const std::uint32_t leaf : cutter_.leaves_of(room.value)) {
    const double v = volume_m3(space_.tree.leaves[leaf]);
    if (v <= most) continue;
    most = v;
    largest = leaf;
  }
  std::vector<Vec3> path;
  const auto is_largest = [&](std::uint32_t leaf) { return leaf == largest; };
  add_way(inner, is_largest, path);
  if (path.empty()) path.push_back(middle_of(space_.tree.leaves[inner]));
  std::reverse(path.begin(), path.end());
  path.push_back(gap);
  add_way_out(cutter_.leaf_at(gap - near_m * n), path);
  return path;
}

}  // namespace enfilade
