#include "hierarchy/patch_shape.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/clip.hpp"

namespace enfilade {
namespace {

/// The parts of a convex polygon where dot(axis, p) is below and above `at`.
std::pair<PatchOutline, PatchOutline> cut(const PatchOutline& vertices, const Vec2& axis,
                                          double at) {
  const auto side = [&](const Vec2& p) { return glm::dot(axis, p) - at; };
  std::size_t crossings = 0, size_below = 0;
  bool was_below = side(vertices.back()) < 0.0;
  for (const Vec2& b : vertices) {
    const bool is_below = side(b) < 0.0;
    if (is_below) ++size_below;
    if (is_below != was_below) ++crossings;
    was_below = is_below;
  }
  std::pair<PatchOutline, PatchOutline> parts;
  PatchOutline &below = parts.first, &above = parts.second;
  // Exactly as large as they will be: there are millions of patches.
  below.reserve(size_below + crossings);
  above.reserve(vertices.size() - size_below + crossings);
  walk_cut(
      vertices, side,
      [&](const Vec2& p, bool is_below) { (is_below ? below : above).push_back(p); },
      [&](const Vec2& p) {
        below.push_back(p);
        above.push_back(p);
      });
  return parts;
}

/// Where the line with dot(axis, p) = at enters a convex polygon and leaves it, along `along`.
std::pair<double, double> chord(const PatchOutline& vertices, const Vec2& axis, double at,
                                const Vec2& along) {
  double first = 1e300, last = -1e300;
  walk_cut(
      vertices, [&](const Vec2& p) { return glm::dot(axis, p) - at; }, [](const Vec2&, bool) {},
      [&](const Vec2& p) {
        const double t = glm::dot(along, p);
        first = std::min(first, t);
        last = std::max(last, t);
      });
  return {first, last};
}

}  // namespace

PatchShape PatchShape::from(const PatchOutline& vertices) {
  PatchShape s;
  s.vertices = vertices;
  const Vec2 o = s.vertices.empty() ? Vec2(0.0) : s.vertices.front();
  double area2 = 0.0;
  Vec2 first(0.0);
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (std::size_t i = 2; i < s.vertices.size(); ++i) {
    const Vec2 a = s.vertices[i - 1] - o, b = s.vertices[i] - o;
    const double w = cross2(a, b);  // twice the triangle's area
    area2 += w;
    first += w * (a + b);
    xx += w * (a.x * a.x + b.x * b.x + a.x * b.x);
    yy += w * (a.y * a.y + b.y * b.y + a.y * b.y);
    xy += w * (2.0 * a.x * a.y + 2.0 * b.x * b.y + a.x * b.y + b.x * a.y);
  }
  s.area_m2 = 0.5 * area2;
  if (area2 <= 0.0) {
    s.centroid = o;
    return s;
  }
  const Vec2 c = first / (3.0 * area2);
  s.centroid = o + c;
  s.cxx = std::max(0.0, xx / (6.0 * area2) - c.x * c.x);
  s.cyy = std::max(0.0, yy / (6.0 * area2) - c.y * c.y);
  s.cxy = xy / (12.0 * area2) - c.x * c.y;
  return s;
}

Vec2 PatchShape::long_axis() const {
  // Nearly isotropic (a square): the polygon's own axis, so that rounding does not choose.
  const double difference = 0.5 * (cxx - cyy);
  const double radius = std::hypot(difference, cxy);
  if (radius <= 1e-6 * (cxx + cyy)) return {1.0, 0.0};
  if (std::abs(cxy) <= 1e-9 * radius) return difference > 0.0 ? Vec2{1.0, 0.0} : Vec2{0.0, 1.0};
  // The half of the angle of (difference, cxy); the larger of its cosine and sine by a root.
  const double root = std::sqrt(0.5 * (1.0 + std::abs(difference) / radius));
  const double other = 0.5 * std::abs(cxy) / (radius * root);
  return difference >= 0.0 ? Vec2{root, std::copysign(other, cxy)}
                           : Vec2{other, std::copysign(root, cxy)};
}

Vec2 PatchShape::deviations() const {
  const double mean = 0.5 * (cxx + cyy);
  const double radius = std::hypot(0.5 * (cxx - cyy), cxy);
  return {std::sqrt(mean + radius), std::sqrt(std::max(0.0, mean - radius))};
}

std::array<Vec2, 4> PatchShape::quadrature() const {
  const Vec2 e1 = long_axis();
  const Vec2 e2{-e1.y, e1.x};
  const Vec2 s = deviations();
  return {centroid - s.x * e1 - s.y * e2, centroid + s.x * e1 - s.y * e2,
          centroid - s.x * e1 + s.y * e2, centroid + s.x * e1 + s.y * e2};
}

Vec2 PatchShape::point_in_quarter(int quarter, double r1, double r2) const {
  const Vec2 e1 = long_axis(), e2{-e1.y, e1.x};
  const Vec2 half = deviations() * std::numbers::sqrt3;  // a rectangle's half sides
  const Vec2 p = centroid + ((quarter & 1) != 0 ? r1 : -r1) * half.x * e1 +
                 ((quarter & 2) != 0 ? r2 : -r2) * half.y * e2;
  return contains({vertices.data(), vertices.size()}, p)
             ? p
             : quadrature()[static_cast<std::size_t>(quarter)];
}

PatchCut PatchShape::cut(std::span<const MeshLine> lines) const {
  // A line that is the border of light over part of the patch only is left to its children.
  constexpr double least_run = 0.5, least_share = 0.1;
  PatchCut best{long_axis(), 0.0};
  best.at = glm::dot(best.axis, centroid);
  double most = 0.0;
  for (const MeshLine& line : lines) {
    const Vec2 along = glm::normalize(line.b - line.a), axis{-along.y, along.x};
    const double at = glm::dot(axis, line.a);
    // A chord that leaves a tenth of a convex shape on either side is not far from its middle.
    if (std::abs(glm::dot(axis, centroid) - at) > 2.0 * deviations().x) continue;
    const auto parts = enfilade::cut(vertices, axis, at);
    if (parts.first.size() < 3 || parts.second.size() < 3) continue;
    const double share = from(parts.first).area_m2 / area_m2;
    const double smaller = std::min(share, 1.0 - share);
    if (smaller < least_share) continue;
    const auto [first, last] = chord(vertices, axis, at, along);
    const double a = glm::dot(along, line.a), b = glm::dot(along, line.b);
    const double run = std::min(last, b) - std::max(first, a);
    if (run < least_run * (last - first) || run * smaller <= most) continue;
    most = run * smaller;
    best = {axis, at};
  }
  return best;
}

std::pair<PatchShape, PatchShape> PatchShape::halves(const PatchCut& cut) const {
  const auto [below, above] = enfilade::cut(vertices, cut.axis, cut.at);
  return {from(below), from(above)};
}

}  // namespace enfilade
