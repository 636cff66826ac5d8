#include "report/pictures/smooth_light.hpp"

#include <cmath>
#include <numbers>
#include <vector>

namespace enfilade {

namespace {

std::size_t leaf_at(const PatchForest& forest, std::uint32_t polygon, const Vec2& q) {
  std::size_t i = polygon;
  while (!forest.node(i).leaf()) {
    const PatchNode& node = forest.node(i);
    i = static_cast<std::size_t>(node.first_child) +
        (glm::dot(node.split_axis, q) >= node.split_at ? 1 : 0);
  }
  return i;
}

}  // namespace

void smooth_irradiance(const PatchForest& forest, std::uint32_t polygon, const Vec3& p, double turn,
                       std::span<double> out) {
  const PolygonFrame& frame = forest.frames()[polygon];
  const PatchOutline& outline = forest.node(polygon).shape.vertices;
  const std::span<const Vec2> border(outline.data(), outline.size());
  const Vec2 q = frame.project(p);
  const double reach_m = 0.6 * std::sqrt(forest.node(leaf_at(forest, polygon, q)).shape.area_m2);
  forest.evaluate(false, polygon, p, out);
  // The samples of a pixel have different turns: together they average over the disc.
  const double angle = std::numbers::pi * turn;
  const double radius_m = reach_m * std::sqrt(std::fmod(4.0 * turn + 0.5, 1.0));
  const Vec2 step = radius_m * Vec2(std::cos(angle), std::sin(angle));
  // Both or none, so that the field's slope cancels.
  if (!contains(border, q + step) || !contains(border, q - step)) return;
  std::vector<double> light(out.size());
  for (const Vec2& at : {q + step, q - step}) {
    forest.evaluate(false, polygon, frame.at(at), light);
    for (std::size_t band = 0; band < out.size(); ++band) out[band] += light[band];
  }
  for (double& value : out) value /= 3.0;
}

}  // namespace enfilade
