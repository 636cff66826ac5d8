#include "light_parts/light_part.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace enfilade {

LightPart LightPart::whole(const LightSource& light) {
  LightPart part;
  part.light = &light;
  part.center = light.p;
  part.last = static_cast<std::uint32_t>(light.opening.size());
  part.measure();
  return part;
}

LightPart LightPart::of(const LightSource& light, std::uint32_t path) {
  int bit = std::bit_width(path) - 2;
  LightPart part;
  part.light = &light;
  part.center = light.p;
  part.last = static_cast<std::uint32_t>(light.opening.size());
  // Only the list that is left in the end need be measured.
  for (; bit >= 0 && part.last > part.first + 1; --bit) {
    const std::uint32_t middle = part.first + (part.last - part.first) / 2;
    (((path >> bit) & 1u) == 0 ? part.last : part.first) = middle;
  }
  part.measure();
  for (; bit >= 0; --bit) part = part.half(static_cast<int>((path >> bit) & 1u));
  return part;
}

LightPart LightPart::half(int side) const {
  LightPart part = *this;
  if (is_point()) return part;
  if (is_one_polygon()) {
    auto halves = shape.halves(shape.cut({}));
    part.shape = side == 0 ? std::move(halves.first) : std::move(halves.second);
    part.share = shape.area_m2 > 0.0 ? share * part.shape.area_m2 / shape.area_m2 : 0.0;
    part.center = frame.at(part.shape.centroid);
    part.radius = 0.0;
    for (const Vec2& p : part.shape.vertices)
      part.radius = std::max(part.radius, glm::length(frame.at(p) - part.center));
    return part;
  }
  const std::uint32_t middle = first + (last - first) / 2;
  (side == 0 ? part.last : part.first) = middle;
  part.measure();
  return part;
}

/// Share, centre and radius of the polygons from first to last; the shape of a single one.
void LightPart::measure() {
  if (is_point()) return;
  share = 0.0;
  Vec3 sum(0.0);
  const double whole_m2 = light->shares.empty() ? total_area_m2(light->opening) : 1.0;
  for (std::uint32_t i = first; i < last; ++i) {
    const double part =
        light->shares.empty() ? area_m2(light->opening[i]) / whole_m2 : light->shares[i];
    share += part;
    sum += part * centroid(light->opening[i]);
  }
  center = sum / share;
  radius = 0.0;
  for (std::uint32_t i = first; i < last; ++i)
    for (const Vec3& p : light->opening[i]) radius = std::max(radius, glm::length(p - center));
  if (!is_one_polygon()) return;
  frame = frame_on(light->opening[first]);
  PatchOutline outline;
  for (const Vec3& p : light->opening[first]) outline.push_back(frame.project(p));
  shape = PatchShape::from(outline);
}

boost::container::small_vector<LightPoint, 6> LightPart::points() const {
  boost::container::small_vector<LightPoint, 6> list;
  if (is_point()) {
    list.push_back({light->p, 1.0});
  } else if (is_one_polygon()) {
    for (const Vec2& q : shape.quadrature()) list.push_back({frame.at(q), 0.25 * share});
  } else {
    for (std::uint32_t i = first; i < last; ++i)
      list.push_back({centroid(light->opening[i]), light->share_of(i)});
  }
  return list;
}

Polygon LightPart::corners() const {
  Polygon list;
  if (is_point()) {
    list.push_back(light->p);
  } else if (is_one_polygon()) {
    for (const Vec2& p : shape.vertices) list.push_back(frame.at(p));
  } else if (light->is_far()) {
    Box box;
    for (std::uint32_t i = first; i < last; ++i) box.add(bounds(light->opening[i]));
    const auto around = box.corners();
    list.assign(around.begin(), around.end());
  } else {
    for (std::uint32_t i = first; i < last; ++i)
      list.insert(list.end(), light->opening[i].begin(), light->opening[i].end());
  }
  return list;
}

Vec3 LightPart::point_in_quarter(int quarter, double r1, double r2) const {
  if (is_point()) return light->p;
  if (is_one_polygon()) return frame.at(shape.point_in_quarter(quarter, r1, r2));
  // A polygon by its area from a quarter of the list, then a point of it.
  double pick = share * (quarter + r1) / 4.0;
  std::uint32_t i = first;
  double part = light->share_of(i);
  while (i + 1 < last && pick >= part) {
    pick -= part;
    part = light->share_of(++i);
  }
  const Polygon& polygon = light->opening[i];
  const double within = std::clamp(part > 0.0 ? pick / part : 0.0, 0.0, 1.0);
  if (polygon.size() != 4) return centroid(polygon) + 0.7 * r2 * (polygon[0] - centroid(polygon));
  return polygon[0] + within * (polygon[1] - polygon[0]) + r2 * (polygon[3] - polygon[0]);
}

double kernel_from(const LightSource& light, const Vec3& y, const Vec3& x, const Vec3& n) {
  const Vec3 d = y - x;
  const double r2 = glm::dot(d, d), cosine = glm::dot(d, n);
  if (cosine <= 0.0) return 0.0;
  return cosine / (r2 * std::sqrt(r2)) * relative_intensity(light, -d);
}

/// Where the points of a polygon differ from its middle by the share s, second order terms do, and
/// the points, which are exact for these, differ from the truth by about s^2.
LightKernel kernel_of(const LightPart& part, const Vec3& x, const Vec3& n) {
  LightKernel kernel;
  for (const LightPoint& point : part.points())
    kernel.at += point.share * kernel_from(*part.light, point.y, x, n);
  if (part.is_point()) return kernel;
  const double middle = part.share * kernel_from(*part.light, part.center, x, n);
  const double most = std::max(middle, kernel.at);
  if (most <= 0.0) return kernel;
  const double differs = std::abs(kernel.at - middle) / most;
  kernel.spread = most * differs * (part.is_one_polygon() ? differs : 1.0);
  return kernel;
}

double power_onto(const LightPart& part, std::span<const Vec3> polygon, const Vec3& n) {
  double sum = 0.0;
  if (part.light->is_far()) {
    // From so far away a solid angle would be lost in rounding.
    const Polygon whole(polygon.begin(), polygon.end());
    const Vec3 middle = centroid(whole);
    for (const LightPoint& point : part.points())
      sum += point.share * kernel_from(*part.light, point.y, middle, n);
    return area_m2(whole) * sum;
  }
  for (const LightPoint& point : part.points()) {
    if (glm::dot(n, point.y - polygon[0]) > 0.0)
      sum += point.share * relative_flux(*part.light, point.y, polygon);
  }
  return sum;
}

}  // namespace enfilade
