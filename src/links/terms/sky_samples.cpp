#include "links/terms/sky_samples.hpp"

#include <algorithm>
#include <cmath>

#include "links/terms/four_point_fit.hpp"

namespace enfilade {
namespace {

/// Corners are taken a little inside: a corner's own walls are no occluders.
constexpr double corner_inset = 0.98;
/// Mean absolute misfit of the affine fit over the patch, per misfit at the corners: 0.26 for x^2 +
/// y^2 and 0.25 for x y on a square.
constexpr double corner_misfit_share = 0.25;
/// Where no point sees the sky, a point between them may still see this share of it.
constexpr double unseen_share = 0.02;

}  // namespace

SkySamples sky_samples(const PolygonFrame& frame, const PatchShape& shape, std::uint32_t own,
                       const LightSource& light, const Occluders& occluders, WorkCount& work) {
  SkySamples found;
  double most = 0.0;
  const auto sample = [&](const Vec2& p) {
    LightAtPoint here = light_at(light, {frame.at(p), frame.n, own}, occluders, &work);
    most = std::max(most, here.irradiance);
    return here;
  };
  const std::array<Vec2, 4> points = shape.quadrature();
  for (std::size_t k = 0; k < 4; ++k) {
    const LightAtPoint here = sample(points[k]);
    found.at[k] = here.irradiance;
    found.error += 0.25 * here.error;
    found.tint.add(here.irradiance, {1.0, here.tint});
  }
  found.center = sample(shape.centroid).irradiance;
  const FourPointFit fit = FourPointFit::of(found.at);
  const Vec2 e1 = shape.long_axis(), e2{-e1.y, e1.x}, s = shape.deviations();
  double off = 0.0;
  for (const Vec2& vertex : shape.vertices) {
    const Vec2 d = corner_inset * (vertex - shape.centroid);
    const double predicted = fit.mean + (s.x > 0.0 ? fit.slope1 * glm::dot(d, e1) / s.x : 0.0) +
                             (s.y > 0.0 ? fit.slope2 * glm::dot(d, e2) / s.y : 0.0);
    off += std::abs(sample(shape.centroid + d).irradiance - predicted);
  }
  found.unfit = corner_misfit_share * off / static_cast<double>(shape.vertices.size());
  if (most <= 0.0) {
    double open = 0.0;
    for (std::size_t i = 0; i < light.opening.size(); ++i) {
      const Vec3 y = centroid(light.opening[i]);
      open += light.share_of(i) * kernel_from(light, y, frame.at(shape.centroid), frame.n);
    }
    found.hidden = unseen_share * open;
  }
  return found;
}

}  // namespace enfilade
