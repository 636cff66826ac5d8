// A light that is no surface: one concept for isotropic points, spots and luminaires.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "geometry/polygon.hpp"
#include "photometry/intensity_distribution.hpp"
#include "photometry/luminous_opening.hpp"

namespace enfilade {

/// One value a spectral band.
using Spectrum = std::vector<double>;

/// The frame of a luminaire in space, of unit vectors at right angles: where its x axis (C = 0), y
/// axis (C = 90) and aim point.
struct LightFrame {
  Vec3 right{1.0, 0.0, 0.0}, up{0.0, 1.0, 0.0}, aim{0.0, 0.0, -1.0};

  /// Returns the frame with this aim, and `up` as nearly as the aim allows; none where both are
  /// parallel. Any lengths but 0.
  static std::optional<LightFrame> of(const Vec3& aim, const Vec3& up);
  /// The same without a wish for up: y, or x for an aim along y.
  static LightFrame of(const Vec3& aim);

  Vec3 to_local(const Vec3& v) const {
    return {glm::dot(v, right), glm::dot(v, up), glm::dot(v, aim)};
  }
  Vec3 to_world(const Vec3& v) const { return v.x * right + v.y * up + v.z * aim; }
};

/// A spot light's cones: half angles from the aim, radians.
struct SpotCone {
  double inner = 0.0, outer = 0.0;
};

/// A light source that reflects nothing and hides nothing. Each point of its opening sends the
/// same distribution: far away that is exact, nearby it is what a photometric file allows to say.
struct LightSource {
  Vec3 p{0.0};         ///< its place; of one with an opening the middle
  Spectrum intensity;  ///< mean over all directions, per band: W/sr, or lm/sr where the unit is
                       ///< lm/m2; the power is 4 pi times this
  std::shared_ptr<const IntensityDistribution> distribution{};  ///< null: isotropic
  LightFrame frame{};
  std::vector<Polygon> opening{};  ///< that its light is spread over, by area; none: a point
  std::string name{};
  std::optional<SpotCone> cone{};  ///< of a spot light
  LuminousOpening shape{};         ///< of a luminaire: what `opening` is made of
  std::string switch_name{};       ///< of the switch that it is on; may be empty
};

/// Returns the intensity towards w (of any length but 0), relative to the mean.
double relative_intensity(const LightSource& light, const Vec3& w);
/// Returns an upper bound of the relative intensity within a cone.
double most_relative_intensity(const LightSource& light, const ViewCone& cone);
/// Returns the integral of the relative intensity over the solid angle (sr) of a convex polygon as
/// point y of the light sees it.
double relative_flux(const LightSource& light, const Vec3& y, std::span<const Vec3> polygon);

/// A ray that leaves a light at random, in proportion to its light.
struct LightRay {
  Vec3 from{0.0}, direction{0.0};
  double weight = 1.0;  ///< what its share of the power is multiplied by
};
/// Returns the ray for uniform numbers in [0, 1): r1 and r2 choose the direction, r3 and r4 the
/// place.
LightRay emitted_ray(const LightSource& light, double r1, double r2, double r3, double r4);
/// Returns the point of the opening for uniform r1 and r2; the place of a point.
Vec3 point_on(const LightSource& light, double r1, double r2);

/// Returns a spot light (KHR_lights_punctual) of the given intensity on its axis, per band.
LightSource spot_light(const Vec3& p, const Vec3& direction, const Spectrum& on_axis,
                       const SpotCone& cone);
/// Puts the opening of shape `light.shape` about its place, in its frame.
void make_opening(LightSource& light);

}  // namespace enfilade
