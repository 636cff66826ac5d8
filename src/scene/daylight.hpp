// The light outside that daylight factors are shares of.
#pragma once

#include "scene/scene.hpp"

namespace enfilade {

/// The irradiance of an unobstructed horizontal plane under the sky alone, per band as solved; or,
/// where a scene has other light as well, so that what arrives inside is no daylight factor, the
/// reason and the remedy.
struct LightOutside {
  Spectrum horizontal;  ///< empty where there is an obstacle
  std::string obstacle{}, remedy{};
};

/// Sunlight must be left out (CIE S 017), also that which the ground reflects. Goes by the light
/// that the scene's lights and surfaces have now, so that lamps may be there, turned off.
LightOutside light_outside(const Scene& scene);

}  // namespace enfilade
