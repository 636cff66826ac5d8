#include "geometry/convex.hpp"

#include <algorithm>
#include <cmath>

namespace enfilade {
namespace {

// A unit vector at right angles to n.
Vec3 any_tangent(const Vec3& n) { return glm::normalize(glm::cross(n, least_axis(n))); }

// A square of the plane, centred at the foot of `center`, of half side `radius`.
Polygon square(const Plane& plane, const Vec3& center, double radius) {
  const Vec3 foot = center - plane.signed_distance(center) * plane.n;
  const Vec3 u = radius * any_tangent(plane.n), v = glm::cross(plane.n, u);
  return {foot - u - v, foot + u - v, foot + u + v, foot - u + v};
}

}  // namespace

Box bounds_along(std::span<const Vec3> points, const Frame& axes) {
  Box box;
  for (const Vec3& p : points) {
    box.add(Vec3(glm::dot(axes[0], p), glm::dot(axes[1], p), glm::dot(axes[2], p)));
  }
  return box;
}

Region box_region(std::span<const Vec3> points, const Frame& axes, double margin) {
  const Box along = bounds_along(points, axes);
  const Vec3 lo = along.lo - Vec3(margin), hi = along.hi + Vec3(margin);
  const Vec3 middle = 0.5 * (lo + hi);
  const Vec3 center = middle.x * axes[0] + middle.y * axes[1] + middle.z * axes[2];
  std::vector<Plane> planes;
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    planes.push_back({axes[axis], hi[k]});
    planes.push_back({-axes[axis], -lo[k]});
  }
  Region region;
  const double radius = glm::length(hi - lo);
  for (const Plane& plane : planes) {
    Polygon polygon = square(plane, center, radius);
    for (const Plane& other : planes) {
      if (std::abs(glm::dot(other.n, plane.n)) < 0.5) clip_behind(polygon, other, 0.0);
    }
    region.facets.push_back({plane, std::move(polygon)});
  }
  return region;
}

Polygon cross_section(const Region& region, const Plane& plane) {
  const Box box = bounds(region);
  Polygon section = square(plane, box.center(), box.diagonal());
  for (const Facet& facet : region.facets) {
    clip_behind(section, facet.plane, 0.0);
    if (section.empty()) break;
  }
  return section;
}

std::pair<Region, Region> split_region(const Region& region, const Plane& plane,
                                       const Polygon& section) {
  std::pair<Region, Region> parts;
  for (const Facet& facet : region.facets) {
    Polygon front = facet.polygon, behind = facet.polygon;
    clip_front(front, plane, 0.0);
    clip_behind(behind, plane, 0.0);
    if (area_m2(front) > 0.0) parts.first.facets.push_back({facet.plane, std::move(front)});
    if (area_m2(behind) > 0.0) parts.second.facets.push_back({facet.plane, std::move(behind)});
  }
  if (!section.empty()) {
    parts.first.facets.push_back({plane.flipped(), Polygon(section.rbegin(), section.rend())});
    parts.second.facets.push_back({plane, section});
  }
  return parts;
}

const Facet* largest_on_border(const Region& part, const Region& whole) {
  const Facet* largest = nullptr;
  double most = 0.0;
  for (const Facet& facet : part.facets) {
    const bool is_on_border = std::ranges::any_of(whole.facets, [&](const Facet& side) {
      return side.plane.n == facet.plane.n && side.plane.d == facet.plane.d;
    });
    const double area = area_m2(facet.polygon);
    if (!is_on_border || (largest != nullptr && area <= most)) continue;
    most = area;
    largest = &facet;
  }
  return largest;
}

DistanceRange distances(const Region& region, const Plane& plane) {
  DistanceRange range;
  for (const Facet& facet : region.facets) {
    for (const Vec3& p : facet.polygon) range.add(plane.signed_distance(p));
  }
  return range;
}

double volume_m3(const Region& region) {
  if (region.facets.empty()) return 0.0;
  const Vec3 origin = region.facets[0].polygon[0];
  double sum = 0.0;
  for (const Facet& facet : region.facets) {
    sum -= facet.plane.signed_distance(origin) * area_m2(facet.polygon);
  }
  return std::max(0.0, sum / 3.0);
}

Box bounds(const Region& region) {
  Box box;
  for (const Facet& facet : region.facets) {
    for (const Vec3& p : facet.polygon) box.add(p);
  }
  return box;
}

Polygon convex_hull(std::vector<Vec3> points, const Vec3& n) {
  if (points.size() < 3) return points;
  const Vec3 origin = points[0], u = any_tangent(n), v = glm::cross(n, u);
  std::vector<std::pair<Vec2, std::size_t>> flat;
  for (std::size_t i = 0; i < points.size(); ++i) {
    flat.push_back({{glm::dot(points[i] - origin, u), glm::dot(points[i] - origin, v)}, i});
  }
  std::sort(flat.begin(), flat.end(), [](const auto& a, const auto& b) {
    return a.first.x < b.first.x || (a.first.x == b.first.x && a.first.y < b.first.y);
  });
  // Andrew's monotone chain, without tolerance: in a column of points that rounding has put out of
  // line a tolerance would take the turn back from its end for a straight line, and lose the end.
  const auto left_turn = [](const Vec2& a, const Vec2& b, const Vec2& c) {
    return cross2(b - a, c - a) > 0.0;
  };
  std::vector<std::pair<Vec2, std::size_t>> hull;
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t floor = hull.size();
    for (const auto& p : flat) {
      while (hull.size() >= floor + 2 &&
             !left_turn(hull[hull.size() - 2].first, hull.back().first, p.first)) {
        hull.pop_back();
      }
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(flat.begin(), flat.end());
  }
  // Now what lies on a straight line between its neighbours can go: one at a time, so that of two
  // vertices in one place only one goes.
  for (std::size_t i = 0; i < hull.size() && hull.size() > 3;) {
    const Vec2 p = hull[i].first;
    const Vec2 to_before = hull[(i + hull.size() - 1) % hull.size()].first - p;
    const Vec2 to_next = hull[(i + 1) % hull.size()].first - p;
    const double area = std::abs(cross2(to_before, to_next));
    const double chord = glm::length(to_next - to_before);
    const bool between = glm::dot(to_before, to_next) <= 0.0;
    if (between && area <= 1e-12 * chord * chord) {
      hull.erase(hull.begin() + static_cast<std::ptrdiff_t>(i));
    } else {
      ++i;
    }
  }
  Polygon polygon;
  for (const auto& [flat_point, index] : hull) polygon.push_back(points[index]);
  return polygon;
}

double diameter(const Polygon& polygon) {
  double most = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    for (std::size_t j = i + 1; j < polygon.size(); ++j) {
      most = std::max(most, glm::length(polygon[i] - polygon[j]));
    }
  }
  return most;
}

}  // namespace enfilade
