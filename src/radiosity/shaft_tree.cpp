#include "radiosity/shaft_tree.hpp"

#include <algorithm>
#include <numeric>

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

/// 1: wholly outside some plane; 0: undecided.
bool outside(const Box& box, std::span<const Plane> shaft, double tolerance_m) {
  for (const Plane& plane : shaft) {
    const Vec3 nearest{plane.n.x > 0 ? box.lo.x : box.hi.x, plane.n.y > 0 ? box.lo.y : box.hi.y,
                       plane.n.z > 0 ? box.lo.z : box.hi.z};
    if (plane.signed_distance(nearest) >= -tolerance_m) return true;
  }
  return false;
}

/// Does any of the polygon lie deeper than the tolerance inside all planes?
bool reaches_into(const Polygon& polygon, std::span<const Plane> shaft, double tolerance_m,
                  Polygon& current, Polygon& next) {
  current = polygon;
  for (const Plane& plane : shaft) {
    next.clear();
    const double d = plane.d - tolerance_m;
    Vec3 a = current.back();
    double side_a = glm::dot(plane.n, a) - d;
    for (const Vec3& b : current) {
      const double side_b = glm::dot(plane.n, b) - d;
      if ((side_a < 0.0) != (side_b < 0.0))
        next.push_back(a + (b - a) * (side_a / (side_a - side_b)));
      if (side_b < 0.0) next.push_back(b);
      a = b;
      side_a = side_b;
    }
    if (next.empty()) return false;
    std::swap(current, next);
  }
  return true;
}

}  // namespace

std::vector<Plane> shaft_between(const Polygon& a, const Polygon& b, double tolerance_m) {
  std::vector<Plane> planes;
  for (const Polygon* polygon : {&a, &b}) {
    if (polygon->size() < 3) continue;  // a point light has no front
    const Plane front = plane_of(*polygon);
    planes.push_back({-front.n, -front.d});
  }
  add_support_planes(a, b, tolerance_m, planes);
  add_support_planes(b, a, tolerance_m, planes);
  return planes;
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
  const Vec3 extent = centers.extent();
  const int axis =
      extent.x >= extent.y && extent.x >= extent.z ? 0 : (extent.y >= extent.z ? 1 : 2);
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

bool ShaftTree::blocked(std::span<const Plane> shaft, double tolerance_m, std::uint32_t skip_a,
                        std::uint32_t skip_b) const {
  std::vector<std::uint32_t> found;
  find(shaft, tolerance_m, skip_a, skip_b, 0, found);
  return !found.empty();
}

void ShaftTree::find(std::span<const Plane> shaft, double tolerance_m, std::uint32_t skip_a,
                     std::uint32_t skip_b, std::size_t most,
                     std::vector<std::uint32_t>& found) const {
  if (nodes_.empty()) return;
  Polygon scratch_a, scratch_b;
  std::vector<std::int32_t> stack{0};
  while (!stack.empty()) {
    const Node& node = nodes_[stack.back()];
    stack.pop_back();
    if (outside(node.box, shaft, tolerance_m)) continue;
    if (node.left >= 0) {
      stack.push_back(node.left);
      stack.push_back(node.right);
      continue;
    }
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
      const std::uint32_t k = order_[i];
      if (k == skip_a || k == skip_b) continue;
      if (!reaches_into(polygons_[k], shaft, tolerance_m, scratch_a, scratch_b)) continue;
      found.push_back(k);
      if (found.size() > most) return;
    }
  }
}

}  // namespace enfilade
