#include "report/pictures/picture_quality.hpp"

#include <algorithm>
#include <cmath>

namespace enfilade {
namespace {

/// The default target error of a solve, and the error from which on a picture is as rough as may
/// be.
constexpr double fine_error = 0.02, rough_error = 0.1;

int between(int fine, int rough, double roughness) {
  return static_cast<int>(std::lround(fine + roughness * (rough - fine)));
}

}  // namespace

RenderConfig picture_quality(double asked_error) {
  const double roughness =
      std::clamp(std::log(asked_error / fine_error) / std::log(rough_error / fine_error), 0.0, 1.0);
  RenderConfig config;
  // The noise of a place's rays falls with the root of their number, and is averaged over some
  // twenty places: of 16 rays it stays below what a rough solution may be wrong by. In report.html
  // all pictures but the first are shown no wider than the rough one.
  config.width = between(config.width, 640, roughness);
  config.height = between(config.height, 360, roughness);
  config.samples = between(config.samples, 3, roughness);
  config.gather_rays = between(config.gather_rays, 16, roughness);
  config.gather_every_px = between(config.gather_every_px, 12, roughness);
  config.direct_every_px = between(config.direct_every_px, 6, roughness);
  return config;
}

}  // namespace enfilade
