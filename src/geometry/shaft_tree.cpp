#include "geometry/shaft_tree.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "geometry/clip.hpp"

namespace enfilade {
namespace {

/// Adds the planes through an edge of `from` and a vertex of `to` that have both polygons behind
/// them.
void add_support_planes(const Polygon& from, const Polygon& to, double tolerance_m,
                        std::vector<Plane>& planes) {
  for (std::size_t i = 0; i < from.size() && from.size() > 1; ++i) {
    const Vec3& p = from[i];
    const Vec3& q = from[(i + 1) % from.size()];
    for (const Vec3& v : to) {
      Vec3 n = glm::cross(q - p, v - p);
      const double length = glm::length(n);
      if (length <= 1e-12 * glm::length(q - p) * glm::length(v - p)) continue;
      n /= length;
      bool above = false, below = false;
      for (const Polygon* polygon : {&from, &to}) {
        for (const Vec3& w : *polygon) {
          const double distance = glm::dot(n, w - p);
          above |= distance > tolerance_m;
          below |= distance < -tolerance_m;
        }
      }
      if (above && below) continue;
      if (above) n = -n;
      planes.push_back({n, glm::dot(n, p)});
    }
  }
}

using PlaneSet = std::uint64_t;  // bit i: plane i of the shaft; those from 64 on are in every set
constexpr std::size_t in_sets = 64;

/// True where the box lies wholly outside the shaft. Removes from `open` the planes that the box
/// lies wholly inside of: the contents of the box need not be tested against these.
bool outside(const Box& box, const Shaft& shaft, double tolerance_m, PlaneSet& open) {
  if (!box.overlaps(shaft.box)) return true;
  const std::vector<Plane>& planes = shaft.planes;
  const Vec3 center = box.center(), half = 0.5 * box.extent();
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const PlaneSet bit = i < in_sets ? PlaneSet{1} << i : 0;
    if (bit != 0 && (open & bit) == 0) continue;
    const double middle = planes[i].signed_distance(center) + tolerance_m;
    const double reach = glm::dot(glm::abs(planes[i].n), half);
    if (middle - reach >= 0.0) return true;
    if (middle + reach < 0.0) open &= ~bit;
  }
  return false;
}

/// Does any of the polygon lie deeper than the tolerance inside all planes?
bool reaches_into(const Polygon& polygon, std::span<const Plane> planes, double tolerance_m,
                  PlaneSet open, Polygon& current, Polygon& next) {
  // Most lie wholly outside one plane; the others need be cut only by the planes that they cross.
  PlaneSet crossed = 0;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    if (i < in_sets && (open >> i & 1) == 0) continue;
    bool inside = false, outside = false;
    for (const Vec3& p : polygon) {
      (planes[i].signed_distance(p) < -tolerance_m ? inside : outside) = true;
    }
    if (!inside) return false;
    if (outside && i < in_sets) crossed |= PlaneSet{1} << i;
  }
  current = polygon;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    if (i < in_sets && (crossed >> i & 1) == 0) continue;
    next.clear();
    walk_cut(
        current, [&](const Vec3& p) { return planes[i].signed_distance(p) + tolerance_m; },
        [&](const Vec3& p, bool is_inside) {
          if (is_inside) next.push_back(p);
        },
        [&](const Vec3& p) { next.push_back(p); });
    if (next.empty()) return false;
    std::swap(current, next);
  }
  return true;
}

/// Is p within reach of the (convex) polygon, counting a little beyond its corners?
bool touches(const Polygon& polygon, const Vec3& p, double reach_m) {
  const Plane plane = plane_of(polygon);
  if (std::abs(plane.signed_distance(p)) > reach_m) return false;
  return contains_within(polygon, plane.n, p, reach_m);
}

}  // namespace

Shaft shaft_between(const Polygon& a, const Polygon& b, double tolerance_m) {
  Shaft shaft{bounds(a), {}};
  shaft.box.add(bounds(b));
  for (const Polygon* polygon : {&a, &b}) {
    if (polygon->size() < 3) continue;  // a point light has no front
    shaft.planes.push_back(plane_of(*polygon).flipped());
  }
  add_support_planes(a, b, tolerance_m, shaft.planes);
  add_support_planes(b, a, tolerance_m, shaft.planes);
  return shaft;
}

ShaftTree::ShaftTree(std::vector<Polygon> polygons)
    : polygons_(std::move(polygons)), order_(polygons_.size()) {
  std::iota(order_.begin(), order_.end(), 0u);
  if (!order_.empty()) build(0, static_cast<std::uint32_t>(order_.size()));
}

std::int32_t ShaftTree::build(std::uint32_t begin, std::uint32_t end) {
  const auto index = static_cast<std::int32_t>(nodes_.size());
  nodes_.emplace_back();
  Box box, centers;
  for (std::uint32_t i = begin; i < end; ++i) {
    const Box b = bounds(polygons_[order_[i]]);
    box.add(b);
    centers.add(b.center());
  }
  nodes_[index].box = box;
  nodes_[index].begin = begin;
  nodes_[index].end = end;
  if (end - begin <= 4) return index;
  const int axis = centers.longest_axis();
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](std::uint32_t i, std::uint32_t j) {
                     const double ci = bounds(polygons_[i]).center()[axis];
                     const double cj = bounds(polygons_[j]).center()[axis];
                     return ci != cj ? ci < cj : i < j;
                   });
  const std::int32_t left = build(begin, middle);
  const std::int32_t right = build(middle, end);
  nodes_[index].left = left;
  nodes_[index].right = right;
  return index;
}

bool ShaftTree::blocked(const Shaft& shaft, double tolerance_m, std::uint32_t skip_a,
                        std::uint32_t skip_b) const {
  std::vector<std::uint32_t> found;
  find(shaft, tolerance_m, skip_a, skip_b, 0, found);
  return !found.empty();
}

void ShaftTree::find(const Shaft& shaft, double tolerance_m, std::uint32_t skip_a,
                     std::uint32_t skip_b, std::size_t most,
                     std::vector<std::uint32_t>& found) const {
  if (nodes_.empty()) return;
  Polygon scratch_a, scratch_b;
  struct Visit {
    std::int32_t node;
    PlaneSet open;
  };
  std::vector<Visit> stack{{0, ~PlaneSet{0}}};
  while (!stack.empty()) {
    auto [index, open] = stack.back();
    const Node& node = nodes_[index];
    stack.pop_back();
    if (outside(node.box, shaft, tolerance_m, open)) continue;
    if (node.left >= 0) {
      stack.push_back({node.left, open});
      stack.push_back({node.right, open});
      continue;
    }
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
      const std::uint32_t k = order_[i];
      if (k == skip_a || k == skip_b) continue;
      if (!reaches_into(polygons_[k], shaft.planes, tolerance_m, open, scratch_a, scratch_b))
        continue;
      found.push_back(k);
      if (found.size() > most) return;
    }
  }
}

void ShaftTree::find_among(std::span<const std::uint32_t> among, const Shaft& shaft,
                           double tolerance_m, std::uint32_t skip_a, std::uint32_t skip_b,
                           std::vector<std::uint32_t>& found) const {
  Polygon scratch_a, scratch_b;
  for (const std::uint32_t k : among) {
    if (k == skip_a || k == skip_b) continue;
    if (reaches_into(polygons_[k], shaft.planes, tolerance_m, ~PlaneSet{0}, scratch_a, scratch_b))
      found.push_back(k);
  }
}

std::vector<std::uint32_t> ShaftTree::touching(const Vec3& p, double reach_m) const {
  std::vector<std::uint32_t> near;
  if (nodes_.empty()) return near;
  const Vec3 margin(reach_m);
  std::vector<std::int32_t> stack{0};
  while (!stack.empty()) {
    const Node& node = nodes_[stack.back()];
    stack.pop_back();
    if (glm::any(glm::lessThan(p + margin, node.box.lo)) ||
        glm::any(glm::greaterThan(p - margin, node.box.hi))) {
      continue;
    }
    if (node.left >= 0) {
      stack.push_back(node.left);
      stack.push_back(node.right);
      continue;
    }
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
      if (touches(polygons_[order_[i]], p, reach_m)) near.push_back(order_[i]);
    }
  }
  std::sort(near.begin(), near.end());
  return near;
}

}  // namespace enfilade
