#include "scene/make_lights.hpp"

#include <algorithm>
#include <numbers>

#include "scene/convex_parts.hpp"

namespace enfilade {
namespace {

constexpr double lift_share = 1e-6;

LightFrame frame_of(const Surface& surface) {
  const Vec3 aim = normal(surface.vertices);
  if (glm::length(surface.up) > 0.0) {
    if (const auto frame = LightFrame::of(aim, surface.up)) return *frame;
  }
  return LightFrame::of(aim);
}

}  // namespace

void make_lights(Scene& scene) {
  const SceneScale scale(scene);
  const double lift_m = lift_share * scale.box().diagonal();
  for (LightSource& light : scene.lights) {
    if (light.shape.shape == OpeningShape::point) continue;
    light.p += lift_m * light.frame.aim;
    make_opening(light);
  }
  for (Surface& surface : scene.surfaces) {
    if (!surface.distribution || !surface.emits()) continue;
    LightSource light;
    light.frame = frame_of(surface);
    light.opening = convex_parts(surface.vertices, scale).parts;
    if (light.opening.empty()) continue;
    const double area = total_area_m2(light.opening);
    for (Polygon& part : light.opening) {
      light.p += area_m2(part) / area * centroid(part);
      for (Vec3& corner : part) corner += lift_m * light.frame.aim;
    }
    light.p += lift_m * light.frame.aim;
    light.distribution = surface.distribution;
    light.name = surface.name;
    light.switch_name = surface.switch_name.empty() ? surface.object : surface.switch_name;
    for (double& band : surface.exitance) {
      light.intensity.push_back(area * band / (4.0 * std::numbers::pi));
      band = 0.0;
    }
    scene.lights.push_back(std::move(light));
  }
  make_sky_lights(scene);
}

}  // namespace enfilade
