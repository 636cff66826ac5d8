#include "cells/rooms/plan_box.hpp"

#include <algorithm>

namespace enfilade {

bool PlanBox::contains(const Vec3& p) const {
  const double a = glm::dot(u, p), b = glm::dot(v, p);
  return a >= u0 && a <= u1 && b >= v0 && b <= v1;
}

PlanBox::Position PlanBox::position_of(const Region& region) const {
  double least_u = 1e300, most_u = -1e300, least_v = 1e300, most_v = -1e300;
  for (const Facet& facet : region.facets) {
    for (const Vec3& p : facet.polygon) {
      const double a = glm::dot(u, p), b = glm::dot(v, p);
      least_u = std::min(least_u, a);
      most_u = std::max(most_u, a);
      least_v = std::min(least_v, b);
      most_v = std::max(most_v, b);
    }
  }
  if (least_u > u1 || most_u < u0 || least_v > v1 || most_v < v0) return Position::outside;
  const bool inside = least_u >= u0 && most_u <= u1 && least_v >= v0 && most_v <= v1;
  return inside ? Position::inside : Position::across;
}

Region PlanBox::part_of(const Region& region) const {
  const Position position = position_of(region);
  if (position == Position::outside) return {};
  Region part = region;
  if (position == Position::inside) return part;
  for (const Plane& side : sides()) {
    part = split_region(part, side, cross_section(part, side)).second;
  }
  return part;
}

Box PlanBox::bounds(const Vec3& up) const {
  constexpr double high_m = 1e9;
  Box box;
  for (const double a : {u0, u1}) {
    for (const double b : {v0, v1}) {
      for (const double h : {-high_m, high_m}) box.add(a * u + b * v + h * up);
    }
  }
  return box;
}

PlanBox box_around(const std::vector<Vec3>& points, const Vec3& up) {
  const Vec3 origin = points.front();
  std::vector<Vec3> flat;
  for (const Vec3& p : points) flat.push_back(p - glm::dot(p - origin, up) * up);
  const Polygon hull = convex_hull(std::move(flat), up);
  PlanBox box;
  double longest = 0.0;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vec3 edge = hull[(i + 1) % hull.size()] - hull[i];
    if (glm::length(edge) <= longest * (1.0 + 1e-6)) continue;
    longest = glm::length(edge);
    box.u = edge / longest;
  }
  if (longest <= 0.0) return box;
  box.v = glm::cross(up, box.u);
  box.u0 = box.v0 = 1e300;
  box.u1 = box.v1 = -1e300;
  for (const Vec3& p : hull) {
    box.u0 = std::min(box.u0, glm::dot(box.u, p));
    box.u1 = std::max(box.u1, glm::dot(box.u, p));
    box.v0 = std::min(box.v0, glm::dot(box.v, p));
    box.v1 = std::max(box.v1, glm::dot(box.v, p));
  }
  return box;
}

}  // namespace enfilade
