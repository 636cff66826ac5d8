#include "modeler/material.hpp"

#include <span>

namespace enfilade {
namespace {

// Values as lighting guides give them (EN 12464-1: ceilings 0.7 to 0.9, walls 0.5 to 0.8, floors
// 0.2 to 0.4), coloured.
constexpr Vec3 ceiling{0.82, 0.82, 0.80};
constexpr Vec3 walls[] = {{0.72, 0.70, 0.64},
                          {0.60, 0.68, 0.72},
                          {0.74, 0.62, 0.48},
                          {0.62, 0.70, 0.55},
                          {0.70, 0.66, 0.66}};
constexpr Vec3 floors[] = {{0.34, 0.28, 0.22}, {0.26, 0.29, 0.32}, {0.38, 0.33, 0.26}};
constexpr Vec3 corridor_floor{0.36, 0.36, 0.34};
constexpr Vec3 facade{0.55, 0.50, 0.44};
constexpr Vec3 concrete{0.45, 0.45, 0.43};
constexpr Vec3 woods[] = {{0.56, 0.40, 0.25}, {0.64, 0.50, 0.34}};
constexpr Vec3 metal{0.52, 0.53, 0.54};
constexpr Vec3 textiles[] = {
    {0.55, 0.12, 0.10}, {0.12, 0.24, 0.46}, {0.22, 0.38, 0.16}, {0.60, 0.42, 0.10}};
constexpr Vec3 plastic{0.22, 0.22, 0.23};
constexpr Vec3 screen{0.06, 0.07, 0.08};
constexpr Vec3 glass{0.10, 0.11, 0.12};
constexpr Vec3 leaves{0.14, 0.34, 0.10};
constexpr Vec3 pictures[] = {{0.62, 0.50, 0.22}, {0.20, 0.40, 0.58}, {0.58, 0.24, 0.30}};
constexpr Vec3 lamp{0.80, 0.80, 0.80};

Vec3 one_of(std::span<const Vec3> list, unsigned variant) { return list[variant % list.size()]; }

Vec3 rgb_of(const Finish& finish) {
  switch (finish.material) {
    case Material::ceiling:
      return ceiling;
    case Material::wall:
      return one_of(walls, finish.variant);
    case Material::floor:
      return one_of(floors, finish.variant);
    case Material::corridor_floor:
      return corridor_floor;
    case Material::facade:
      return facade;
    case Material::concrete:
      return concrete;
    case Material::wood:
      return one_of(woods, finish.variant);
    case Material::metal:
      return metal;
    case Material::textile:
      return one_of(textiles, finish.variant);
    case Material::plastic:
      return plastic;
    case Material::screen:
      return screen;
    case Material::glass:
      return glass;
    case Material::leaves:
      return leaves;
    case Material::picture:
      return one_of(pictures, finish.variant);
    case Material::lamp:
      return lamp;
  }
  return Vec3(0.5);
}

}  // namespace

Spectrum reflectance_of(const Finish& finish, bool colours) {
  const Vec3 rgb = rgb_of(finish);
  if (colours) return {rgb.x, rgb.y, rgb.z};
  // Luminance of linear sRGB, in whole thousandths.
  const double grey = 0.2126 * rgb.x + 0.7152 * rgb.y + 0.0722 * rgb.z;
  return {static_cast<int>(1000.0 * grey + 0.5) / 1000.0};
}

}  // namespace enfilade
