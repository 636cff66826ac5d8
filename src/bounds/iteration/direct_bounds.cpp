#include "bounds/iteration/direct_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.hpp"
#include "bounds/factors/inverse_power.hpp"
#include "geometry/visible_parts.hpp"

namespace enfilade {
namespace {

constexpr std::size_t most_occluders = 200;

Range squared_distances(const Vec3& light, const FlatShape& shape) {
  const FlatShape point({light}, shape.plane);
  const double least = least_distance(point, shape), most = largest_distance(point, shape);
  return {least * least, std::max(least * least, most * most)};
}

/// Bounds of the integral of r^-3 over the shape, 1/m.
Range integral(const Vec3& light, const FlatShape& shape, int depth) {
  const Range s = squared_distances(light, shape);
  if (s.lo <= 0.0) return {0.0, 1e300};
  if (depth > 0 && s.hi - s.lo > 0.2 * (s.hi + s.lo)) {
    const auto [first, second] = halves(shape);
    const Range a = integral(light, first, depth - 1), b = integral(light, second, depth - 1);
    return {a.lo + b.lo, a.hi + b.hi};
  }
  const PowerBounds power = bound_power(-1.5, s.lo, s.hi, true);
  std::vector<QuadraturePoint> points;
  add_quadrature(shape, true, points);
  Range sum;
  for (const QuadraturePoint& q : points) {
    const double r2 = glm::dot(q.p - light, q.p - light);
    sum.lo += q.weight_m2 * power.below(r2);
    sum.hi += q.weight_m2 * power.above(r2);
  }
  return {std::max(sum.lo, shape.area_m2 * std::pow(s.hi, -1.5)),
          std::min(sum.hi, shape.area_m2 * std::pow(s.lo, -1.5))};
}

}  // namespace

Range intensity_towards(const LightSource& light, std::size_t band, const FlatShape& receiver) {
  const double mean = light.intensity[band];
  if (light.distribution == nullptr && !light.cone) return {mean, mean};
  // A cone about the middle of both that holds all directions between them.
  double reach = receiver.radius_m;
  for (const Polygon& part : light.opening) {
    for (const Vec3& p : part)
      reach = std::max(reach, receiver.radius_m + glm::length(p - light.p));
  }
  const Vec3 direction = receiver.center - light.p;
  const double distance = glm::length(direction);
  ViewCone cone{Vec3(0.0, 0.0, 1.0), std::numbers::pi};
  if (distance > reach) cone = {direction / distance, std::asin(reach / distance)};
  return {0.0, mean * most_relative_intensity(light, cone)};
}

LightRange opening_bounds(const LightSource& light, const PatchOfPolygon& receiver,
                          const PairFactors& scene) {
  LightRange e;
  for (const Polygon& part : light.opening) {
    double height = 0.0;
    for (const Vec3& p : part) height = std::max(height, receiver.shape.plane.signed_distance(p));
    if (height <= scene.tolerance_m()) continue;
    const double least = least_distance(FlatShape(part, plane_of(part)), receiver.shape);
    if (least <= 0.0) {
      throw InputError("scene", "lights", "the opening of a light touches a surface in front of it",
                       "move the light; bounds know no limit of its light there");
    }
    e.at_points.hi = std::max(e.at_points.hi, std::min(1.0, height / least) / (least * least));
  }
  e.mean.hi = e.at_points.hi;
  return e;
}

LightRange direct_bounds(const Vec3& light, const PatchOfPolygon& receiver,
                         const PairFactors& scene) {
  const FlatShape& shape = receiver.shape;
  const double height = shape.plane.signed_distance(light);
  if (height <= scene.tolerance_m()) return {};
  std::vector<std::uint32_t> between;
  const Polygon source{light};
  scene.tree().find(shaft_between(shape.polygon, source, scene.tolerance_m()), scene.tolerance_m(),
                    receiver.polygon, no_occluder, most_occluders, between);
  VisibleParts parts, undimmed;
  parts.begin(light, shape.polygon, scene.tolerance_m());
  bool known = between.size() <= most_occluders;
  for (const std::uint32_t k : between) {
    if (!scene.is_pane(k)) known = known && parts.hide(scene.tree().polygon(k), 500);
  }
  undimmed = parts;
  for (const std::uint32_t k : between) {
    if (scene.is_pane(k)) known = known && undimmed.hide(scene.tree().polygon(k), 500);
  }
  if (known && parts.empty()) return {};
  const Range s = squared_distances(light, shape);
  LightRange e;
  e.at_points = {between.empty() ? height * std::pow(s.hi, -1.5) : 0.0,
                 s.lo > 0.0 ? height * std::pow(s.lo, -1.5) : 1.0 / (height * height)};
  if (!known) {
    e.mean = {0.0, height * integral(light, shape, 8).hi / shape.area_m2};
  } else {
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const FlatShape part(Polygon(parts[i].begin(), parts[i].end()), shape.plane);
      if (part.area_m2 <= 0.0) continue;
      const Range f = integral(light, part, 8);
      e.mean.hi += height * f.hi / shape.area_m2;
    }
  }
  for (std::size_t i = 0; i < undimmed.size() && known; ++i) {
    const FlatShape part(Polygon(undimmed[i].begin(), undimmed[i].end()), shape.plane);
    if (part.area_m2 > 0.0) e.mean.lo += height * integral(light, part, 8).lo / shape.area_m2;
  }
  e.mean.hi = std::min(e.mean.hi, e.at_points.hi);
  return e;
}

}  // namespace enfilade
