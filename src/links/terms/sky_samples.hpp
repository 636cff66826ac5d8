// What a dome of the sky brings to a patch, exact at some of its points.
#pragma once

#include <array>

#include "base/work_count.hpp"
#include "hierarchy/patch_forest.hpp"
#include "occluders/light_at.hpp"

namespace enfilade {

/// Irradiance per unit of the light's intensity.
struct SkySamples {
  std::array<double, 4> at{};  ///< at PatchShape::quadrature
  double center = 0.0;
  double unfit = 0.0;   ///< mean misfit of the affine fit to the four points, by the corners
  double hidden = 0.0;  ///< where all points are dark: what may arrive between them
  double error = 0.0;   ///< mean of the points' own
  TintSum tint{};
};

/// By sky_at() at the four points, the centre and the corners of a patch. `own`: global number of
/// its polygon.
SkySamples sky_samples(const PolygonFrame& frame, const PatchShape& shape, std::uint32_t own,
                       const LightSource& light, const Occluders& occluders, WorkCount& work);

}  // namespace enfilade
