// The diffuse part of a Radiance material, and the light that it gives off.
#pragma once

#include <memory>

#include "import/radiance/radiance_distribution.hpp"
#include "import/radiance/radiance_primitive.hpp"
#include "scene/scene.hpp"

namespace enfilade {

/// Spectra of three bands: red, green, blue.
struct RadianceMaterial {
  Spectrum reflectance{0.0, 0.0, 0.0};  ///< of both sides
  Spectrum exitance{0.0, 0.0, 0.0};     ///< W/m2, of the front alone
  Spectrum transmittance{};             ///< of glass, at normal incidence; else empty
  bool passes_light = false;            ///< rays pass through it: shapes of it are left out
  /// How its light is distributed; null: as from a dull surface.
  std::shared_ptr<const RadianceDistribution> distribution{};
  std::vector<std::string> losses;  ///< properties that a scene can't hold, for warnings

  bool reflects() const;
  bool emits() const;
};

/// Diffuse reflectance is color x (1 - specular) x (1 - transmission). A radiance L in W/(sr m2),
/// the same in all directions, is an exitance of pi L in W/m2. Fails for arguments that are
/// missing or below zero.
RadianceMaterial radiance_material(const RadiancePrimitive& material);

}  // namespace enfilade
