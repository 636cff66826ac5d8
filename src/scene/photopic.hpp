// Lumens and lux of scenes in watts, and of scenes in several bands.
#pragma once

#include "scene/scene.hpp"

namespace enfilade {

/// Lumens per watt of light that is alike in all bands: Radiance's white efficacy (Ward 1998).
inline constexpr double lumens_per_watt = 179.0;

/// Returns the one photopic value of a quantity per band of the file, in lumens (or lx, lm/m2).
/// Three bands are red, green and blue, weighted by their luminance: in lumens by ITU-R BT.709
/// (0.2126, 0.7152, 0.0722), as glTF has them; in watts by Radiance's (0.265, 0.670, 0.065). Other
/// numbers of bands count alike. Watts are multiplied by lumens_per_watt.
double photopic(std::span<const double> bands, ExitanceUnit unit);

/// Returns the factor from lumens to the scene's unit of power.
inline double per_lumen(ExitanceUnit unit) {
  return unit == ExitanceUnit::lumen_per_m2 ? 1.0 : 1.0 / lumens_per_watt;
}

}  // namespace enfilade
