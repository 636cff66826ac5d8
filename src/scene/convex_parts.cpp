#include "scene/convex_parts.hpp"

#include <cmath>
#include <numbers>
#include <numeric>
#include <tuple>

#include "geometry/convex_merge.hpp"
#include "geometry/triangulation.hpp"

namespace enfilade {
namespace {

double turn(const Vec2& a, const Vec2& b, const Vec2& c) { return cross2(b - a, c - b); }

// Takes out vertices that repeat their neighbour, and those where the outline runs back on itself.
Polygon without_repeats(Polygon p, double same) {
  for (bool again = true; again && p.size() >= 3;) {
    again = false;
    for (std::size_t i = 0; i < p.size() && p.size() >= 3;) {
      const Vec3& before = p[(i + p.size() - 1) % p.size()];
      const Vec3& after = p[(i + 1) % p.size()];
      const bool repeat = glm::length(p[i] - before) <= same;
      if (repeat || glm::length(after - before) <= same) {
        p.erase(p.begin() + static_cast<std::ptrdiff_t>(i));
        again = true;
      } else {
        ++i;
      }
    }
  }
  return p;
}

std::size_t farthest_from(const Polygon& p, const Vec3& from) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < p.size(); ++i) {
    if (glm::length(p[i] - from) > glm::length(p[best] - from)) best = i;
  }
  return best;
}

/// Coordinates in the plane of a polygon.
struct Frame {
  Vec3 origin, x, y, n;
  Frame(const Vec3& o, const Vec3& normal) : origin(o), n(normal) {
    const Vec3 other = std::abs(n.z) < 0.9 ? Vec3(0, 0, 1) : Vec3(1, 0, 0);
    x = glm::normalize(glm::cross(other, n));
    y = glm::cross(n, x);
  }
  Vec2 down(const Vec3& p) const { return {glm::dot(p - origin, x), glm::dot(p - origin, y)}; }
  Vec3 up(const Vec2& p) const { return origin + p.x * x + p.y * y; }
};

bool turns_left_once(const std::vector<Vec2>& p) {
  double total = 0.0;
  const std::size_t n = p.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 in = p[i] - p[(i + n - 1) % n], out = p[(i + 1) % n] - p[i];
    const double cross = cross2(in, out);
    if (cross < 0.0) return false;
    total += std::atan2(cross, glm::dot(in, out));
  }
  return total < 3.0 * std::numbers::pi;
}

// Numbers of the hull's corners, counter-clockwise (Andrew's monotone chain).
std::vector<std::size_t> hull_of(const std::vector<Vec2>& p) {
  std::vector<std::size_t> order(p.size()), hull;
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::tie(p[a].x, p[a].y, a) < std::tie(p[b].x, p[b].y, b);
  });
  for (int half = 0; half < 2; ++half) {
    const std::size_t start = hull.size();
    for (const std::size_t i : order) {
      while (hull.size() >= start + 2 &&
             turn(p[hull[hull.size() - 2]], p[hull.back()], p[i]) <= 0.0)
        hull.pop_back();
      hull.push_back(i);
    }
    hull.pop_back();
    std::reverse(order.begin(), order.end());
  }
  return hull;
}

// The vertices on the hull, if no vertex lies deeper inside than `tolerance`; none otherwise.
std::vector<std::size_t> nearly_convex(const std::vector<Vec2>& p, double tolerance, double exact) {
  std::vector<std::size_t> hull = hull_of(p), kept;
  std::rotate(hull.begin(), std::min_element(hull.begin(), hull.end()), hull.end());
  if (hull.size() < 3 || !std::is_sorted(hull.begin(), hull.end())) return {};
  for (std::size_t h = 0; h < hull.size(); ++h) {
    const std::size_t a = hull[h], b = hull[(h + 1) % hull.size()];
    const double length = glm::length(p[b] - p[a]);
    const Vec2 along = (p[b] - p[a]) / length;
    double reached = 0.0;
    kept.push_back(a);
    for (std::size_t i = (a + 1) % p.size(); i != b; i = (i + 1) % p.size()) {
      const Vec2 v = p[i] - p[a];
      const double depth = cross2(along, v), t = glm::dot(v, along);
      if (depth > tolerance || t < reached - tolerance) return {};
      if (depth <= exact && t > reached && t < length) kept.push_back(i);
      reached = std::max(reached, t);
    }
  }
  return kept;
}

ConvexParts split_up(const Polygon& polygon, const std::vector<Vec2>& flat, const Frame& frame,
                     bool planar, double extent, double tolerance) {
  const Triangulation mesh = triangulate(flat, tolerance * extent);
  if (!mesh.simple) return {PolygonShape::self_intersecting, {}};
  std::vector<Vec3> points = polygon;
  for (std::size_t i = points.size(); i < mesh.points.size(); ++i)
    points.push_back(frame.up(mesh.points[i]));
  std::vector<IndexLoop> loops;
  for (const auto& t : mesh.triangles) loops.emplace_back(t.begin(), t.end());
  ConvexParts result{planar ? PolygonShape::non_convex : PolygonShape::non_planar, {}};
  for (const IndexLoop& loop : merge_convex(points, std::move(loops), tolerance, 1e-12)) {
    Polygon part;
    for (const std::uint32_t i : loop) part.push_back(points[i]);
    result.parts.push_back(std::move(part));
  }
  return result;
}

}  // namespace

double width_of(const Polygon& polygon) {
  if (polygon.size() < 3) return 0.0;
  const Vec3& a = polygon[farthest_from(polygon, polygon[0])];
  const Vec3& b = polygon[farthest_from(polygon, a)];
  const double length = glm::length(b - a);
  double width = 0.0;
  for (const Vec3& p : polygon) width = std::max(width, glm::length(glm::cross(p - a, b - a)));
  return length > 0.0 ? width / length : 0.0;
}

ConvexParts convex_parts(const Polygon& raw, const SceneScale& scale) {
  Polygon polygon = without_repeats(raw, scale.same_vertex(bounds(raw).diagonal()));
  const double extent = bounds(polygon).diagonal(), tolerance = scale.flat(extent);
  const double width = width_of(polygon);
  if (polygon.size() < 3 || width <= scale.sliver(extent)) return {PolygonShape::degenerate, {}};
  // Wide, yet without area: its loops run in opposite senses and cancel.
  if (area_m2(polygon) < 1e-6 * width * extent) return {PolygonShape::self_intersecting, {}};
  const Frame frame(polygon[0], normal(polygon));
  const Plane plane = plane_of(polygon);
  std::vector<Vec2> flat;
  bool planar = true;
  for (const Vec3& p : polygon) {
    flat.push_back(frame.down(p));
    planar &= std::abs(plane.signed_distance(p)) <= tolerance;
  }
  if (planar && turns_left_once(flat)) return {PolygonShape::convex, {std::move(polygon)}};
  if (planar) {
    Polygon hull;
    for (const std::size_t i : nearly_convex(flat, tolerance, scale.same_vertex(extent)))
      hull.push_back(polygon[i]);
    if (!hull.empty()) return {PolygonShape::convex, {std::move(hull)}};
  }
  return split_up(polygon, flat, frame, planar, extent, tolerance);
}

}  // namespace enfilade
