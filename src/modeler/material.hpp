// Materials and their reflectances.
#pragma once

#include "scene/scene.hpp"

namespace enfilade {

enum class Material {
  ceiling,
  wall,
  floor,
  corridor_floor,
  facade,
  concrete,
  wood,
  metal,
  textile,
  plastic,
  screen,
  glass,
  leaves,
  picture,
  lamp
};

/// Several paints and cloths: the variant chooses one, any number will do.
struct Finish {
  Material material = Material::wall;
  unsigned variant = 0;
};

/// Returns red, green and blue, or one grey band of the same luminance.
Spectrum reflectance_of(const Finish& finish, bool colours);

}  // namespace enfilade
