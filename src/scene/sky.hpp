// The light of the sky: its luminance by direction, the sun, and the ground that it lights.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "base/geometry.hpp"

namespace enfilade {

struct LightSource;
struct Scene;

/// Luminance by direction, relative to the zenith's: phi(Z) f(chi) / (phi(0) f(Zs)) with the
/// gradation phi(Z) = 1 + a exp(b / cos Z) by the angle Z from the zenith and the indicatrix f(chi)
/// = 1 + c (exp(d chi) - exp(d pi / 2)) + e cos^2 chi by the angle chi from the sun, whose zenith
/// distance is Zs (CIE S 011 / ISO 15469, CIE Standard General Sky).
struct SkyShape {
  double a = 0.0, b = -1.0, c = 0.0, d = -1.0, e = 0.0;
  /// CIE Standard Overcast Sky, (1 + 2 cos Z) / 3 (Moon and Spencer 1942), in place of phi and f.
  bool overcast = false;

  /// One of the standard's types 1 to 15: 5 is uniform, 12 the clear sky of low turbidity.
  static SkyShape of_type(int type);
  bool needs_sun() const { return !overcast && (c != 0.0 || e != 0.0); }
  /// `zenith` and `sun` are unit vectors; `toward` is of any length, above the horizon.
  double relative(const Vec3& toward, const Vec3& zenith, const Vec3& sun) const;
};

/// A sky, with values in the scene's unit: lx and cd/m2, or W/m2 and W/(m2 sr).
struct Sky {
  SkyShape shape{};
  Vec3 zenith{0.0, 0.0, 1.0};                ///< up, a unit vector
  Vec3 sun{0.0, 0.0, 1.0};                   ///< to the sun, a unit vector
  std::vector<double> zenith_luminance;      ///< per band
  std::vector<double> sun_illuminance{};     ///< on a plane that faces it; empty: no sun
  std::vector<double> ground_reflectance{};  ///< per band; empty: black

  double relative(const Vec3& toward) const { return shape.relative(toward, zenith, sun); }
  /// Returns the irradiance of an unobstructed horizontal plane by the sky alone per unit of the
  /// zenith's luminance (sr).
  double horizontal_per_zenith() const;
  /// Returns the irradiance of an unobstructed horizontal plane by the sky, and by the sun where
  /// `with_sun`, in each band.
  std::vector<double> horizontal(bool with_sun) const;
};

/// Adds the scene's sky to its lights: a dome far beyond it, the ground below the horizon, and the
/// sun's disc.
void make_sky_lights(Scene& scene);

/// Returns the luminance per band of the sky, the ground and the sun's disc in a direction of any
/// length, of those that are among the lights.
std::vector<double> far_luminance(std::span<const LightSource> lights, const Vec3& direction);

}  // namespace enfilade
