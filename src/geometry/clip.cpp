// Cuts with a tolerance: corners that are closer to the plane than that are taken as on it.
#include "geometry/clip.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace enfilade {
namespace {

/// Signed distances of the corners from the plane, those within the tolerance taken as zero.
struct SnappedDistances {
  std::span<const double> of_corner;
  bool any_front = false, any_behind = false;
  double operator[](std::size_t i) const { return of_corner[i]; }
};

/// Valid until the next call in the same thread: the values stay where they are, so that a clip
/// allocates nothing for them.
SnappedDistances snapped_distances(const Polygon& polygon, const Plane& plane, double tolerance) {
  thread_local std::vector<double> values;
  values.resize(polygon.size());
  SnappedDistances found;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    values[i] = plane.signed_distance(polygon[i]);
    if (std::abs(values[i]) <= tolerance) values[i] = 0.0;
    found.any_front |= values[i] > 0.0;
    found.any_behind |= values[i] < 0.0;
  }
  found.of_corner = values;
  return found;
}

/// Appends the corners of the part behind the plane, and where `front` is given those of the part
/// in front; corners on the plane belong to both.
void cut(const Polygon& polygon, const SnappedDistances& distance, Polygon& behind,
         Polygon* front) {
  const std::size_t count = polygon.size();
  behind.reserve(behind.size() + count + 1);
  if (front != nullptr) front->reserve(front->size() + count + 1);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t j = i + 1 == count ? 0 : i + 1;
    if (front != nullptr && distance[i] >= 0.0) front->push_back(polygon[i]);
    if (distance[i] <= 0.0) behind.push_back(polygon[i]);
    if (distance[i] * distance[j] >= 0.0) continue;
    // From the front end always, so that two polygons that share the edge get the very same point.
    const std::size_t f = distance[i] > 0.0 ? i : j, b = f == i ? j : i;
    const Vec3 crossing = zero_crossing(polygon[f], distance[f], polygon[b], distance[b]);
    if (front != nullptr) front->push_back(crossing);
    behind.push_back(crossing);
  }
}

/// Outward planes through the edges of a polygon, without those of edges that are too short.
std::vector<Plane> border_of(const Polygon& polygon) {
  return edge_planes(polygon, normal(polygon), 1e-12 * bounds(polygon).diagonal());
}

/// The order in which a border's edges are cut along. Of many edges those that halve what is left
/// come first: cut one after the other, each would leave a sliver that reaches from it to the far
/// side, and all of these would lie in each other's boxes.
std::vector<std::size_t> cutting_order(std::size_t edges) {
  constexpr std::size_t few_edges = 64;
  std::vector<std::size_t> order;
  if (edges <= few_edges) {
    for (std::size_t i = 0; i < edges; ++i) order.push_back(i);
    return order;
  }
  order.push_back(0);
  for (std::size_t step = std::bit_ceil(edges) / 2; step > 0; step /= 2) {
    for (std::size_t i = step; i < edges; i += 2 * step) order.push_back(i);
  }
  return order;
}

}  // namespace

std::pair<Polygon, Polygon> split(const Polygon& polygon, const Plane& plane, double tolerance) {
  const SnappedDistances distance = snapped_distances(polygon, plane, tolerance);
  if (!distance.any_behind) return {polygon, {}};
  if (!distance.any_front) return {{}, polygon};
  std::pair<Polygon, Polygon> parts;
  cut(polygon, distance, parts.second, &parts.first);
  return parts;
}

void clip_behind(Polygon& polygon, const Plane& plane, double tolerance) {
  const SnappedDistances distance = snapped_distances(polygon, plane, tolerance);
  if (!distance.any_front) return;
  thread_local Polygon kept;  // so that a clip seldom allocates memory
  kept.clear();
  if (distance.any_behind) cut(polygon, distance, kept, nullptr);
  if (kept.size() < 3) kept.clear();
  polygon.assign(kept.begin(), kept.end());
}

void clip_front(Polygon& polygon, const Plane& plane, double tolerance) {
  clip_behind(polygon, plane.flipped(), tolerance);
}

bool clip_front(Segment& s, const Plane& plane, double tolerance) {
  const double at_a = plane.signed_distance(s.a), at_b = plane.signed_distance(s.b);
  if (std::max(at_a, at_b) <= tolerance) return false;
  if (at_a < 0.0) s.a = zero_crossing(s.a, at_a, s.b, at_b);
  if (at_b < 0.0) s.b = zero_crossing(s.b, at_b, s.a, at_a);
  return true;
}

std::vector<Polygon> subtract_coplanar(const Polygon& a, const Polygon& b, double tolerance) {
  std::vector<Polygon> left;
  Polygon inside = a;
  const std::vector<Plane> planes = border_of(b);
  if (planes.size() < 3) return {a};
  const Box box = bounds(a);
  const double reach = 0.5 * box.diagonal() + tolerance;
  for (const std::size_t edge : cutting_order(planes.size())) {
    const Plane& plane = planes[edge];
    // Where `b` has many edges, `a` lies behind most of them.
    if (plane.signed_distance(box.center()) < -reach) continue;
    // An edge of `a` that lies in the plane up to tolerance must stay inside: only what sticks out
    // is cut.
    const SnappedDistances distance = snapped_distances(inside, plane, tolerance);
    if (!distance.any_behind) return {a};
    if (!distance.any_front) continue;
    Polygon rest;
    cut(inside, distance, rest, &left.emplace_back());
    inside = std::move(rest);
  }
  return left;
}

Polygon intersect_coplanar(const Polygon& a, const Polygon& b, double tolerance) {
  Polygon inside = a;
  const std::vector<Plane> planes = border_of(b);
  if (planes.size() < 3) return {};
  for (const Plane& plane : planes) {
    const SnappedDistances distance = snapped_distances(inside, plane, tolerance);
    if (!distance.any_behind) return {};
    if (!distance.any_front) continue;
    Polygon rest;
    cut(inside, distance, rest, nullptr);
    inside = std::move(rest);
  }
  return inside;
}

}  // namespace enfilade
