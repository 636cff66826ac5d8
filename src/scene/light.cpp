#include "scene/light.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <boost/container/small_vector.hpp>

#include "geometry/form_factor.hpp"
#include "geometry/sampling.hpp"

namespace enfilade {

std::optional<LightFrame> LightFrame::of(const Vec3& aim, const Vec3& up) {
  LightFrame frame;
  frame.aim = glm::normalize(aim);
  const Vec3 across = up - glm::dot(up, frame.aim) * frame.aim;
  constexpr double parallel = 1e-9;
  if (glm::length(across) <= parallel * glm::length(up)) return std::nullopt;
  frame.up = glm::normalize(across);
  frame.right = glm::cross(frame.aim, frame.up);
  return frame;
}

LightFrame LightFrame::of(const Vec3& aim) {
  const auto frame = of(aim, {0.0, 1.0, 0.0});
  return frame ? *frame : of(aim, {1.0, 0.0, 0.0}).value();
}

double relative_intensity(const LightSource& light, const Vec3& w) {
  if (!light.distribution) return 1.0;
  return light.distribution->intensity(light.frame.to_local(w)) / light.distribution->mean();
}

double most_relative_intensity(const LightSource& light, const ViewCone& cone) {
  if (!light.distribution) return 1.0;
  const ViewCone local{light.frame.to_local(cone.axis), cone.half_angle};
  return light.distribution->most_within(local) / light.distribution->mean();
}

double relative_flux(const LightSource& light, const Vec3& y, std::span<const Vec3> polygon) {
  if (!light.distribution) return solid_angle(y, polygon);
  boost::container::small_vector<Vec3, 8> corners;
  for (const Vec3& corner : polygon) corners.push_back(light.frame.to_local(corner - y));
  return light.distribution->flux_within({corners.data(), corners.size()}) /
         light.distribution->mean();
}

double LightSource::share_of(std::size_t polygon) const {
  return shares.empty() ? area_m2(opening[polygon]) / total_area_m2(opening) : shares[polygon];
}

double power_per_intensity(const LightSource& light) {
  if (!light.is_far()) return 4.0 * std::numbers::pi;
  const double angle = light.reach_m / light.far_m;
  return std::numbers::pi * angle * angle;
}

Vec3 point_on(const LightSource& light, double r1, double r2) {
  if (light.opening.empty()) return light.p;
  const double whole = light.shares.empty() ? total_area_m2(light.opening) : 1.0;
  const auto part = [&](std::size_t k) {
    return light.shares.empty() ? area_m2(light.opening[k]) : light.shares[k];
  };
  double pick = r1 * whole;
  std::size_t i = 0;
  double share = part(0);
  while (i + 1 < light.opening.size() && pick >= share) {
    pick -= share;
    share = part(++i);
  }
  constexpr double below_one = 1.0 - 1e-12;
  const double within = share > 0.0 ? pick / share : 0.0;
  return uniform_point(light.opening[i], std::clamp(within, 0.0, below_one), r2);
}

namespace {

/// From a far light to a point of the disc across the ray, about the middle of what it lights.
LightRay far_ray(const LightSource& light, double r1, double r2, double r3, double r4) {
  const Vec3 from = point_on(light, r3, r4);
  const Vec3 center = light.sky ? light.p : light.p + light.far_m * light.frame.aim;
  const LightFrame frame = LightFrame::of(center - from);
  const double r = light.reach_m * std::sqrt(r1), turn = 2.0 * std::numbers::pi * r2;
  const Vec3 at = center + r * (std::cos(turn) * frame.right + std::sin(turn) * frame.up);
  // Single precision would lose the scene from there.
  const Vec3 near = at - 2.0 * light.reach_m * frame.aim;
  return {near, frame.aim, 1.0};
}

}  // namespace

LightRay emitted_ray(const LightSource& light, double r1, double r2, double r3, double r4) {
  if (light.is_far()) return far_ray(light, r1, r2, r3, r4);
  LightRay ray{point_on(light, r3, r4), sphere_direction(2.0 * r1 - 1.0, r2), 1.0};
  if (!light.distribution) return ray;
  const SampledDirection sampled = light.distribution->sample(r1, r2);
  ray.direction = light.frame.to_world(sampled.toward);
  ray.weight = sampled.weight;
  return ray;
}

LightSource spot_light(const Vec3& p, const Vec3& direction, const Spectrum& on_axis,
                       const SpotCone& cone) {
  LightSource light{p, on_axis};
  light.distribution =
      std::make_shared<const IntensityDistribution>(spot_distribution(cone.inner, cone.outer));
  light.frame = LightFrame::of(direction);
  light.cone = cone;
  for (double& band : light.intensity) band *= light.distribution->mean();
  return light;
}

void make_opening(LightSource& light) {
  light.opening.clear();
  for (const std::vector<Vec3>& face : light.shape.faces()) {
    Polygon& polygon = light.opening.emplace_back();
    for (const Vec3& corner : face) polygon.push_back(light.p + light.frame.to_world(corner));
  }
}

}  // namespace enfilade
