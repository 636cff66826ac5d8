#include "modeler/material.hpp"

#include <span>

namespace enfilade {
namespace {

// Values as lighting guides give them (EN 12464-1: ceilings 0.7 to 0.9, walls 0.5 to 0.8, floors
// 0.2 to 0.4), coloured.
constexpr Vec3 ceiling_rgb{0.82, 0.82, 0.80};
constexpr Vec3 walls_rgb[] = {{0.72, 0.70, 0.64},
                              {0.60, 0.68, 0.72},
                              {0.74, 0.62, 0.48},
                              {0.62, 0.70, 0.55},
                              {0.70, 0.66, 0.66}};
constexpr Vec3 floors_rgb[] = {{0.34, 0.28, 0.22}, {0.26, 0.29, 0.32}, {0.38, 0.33, 0.26}};
constexpr Vec3 corridor_floor_rgb{0.36, 0.36, 0.34};
constexpr Vec3 facade_rgb{0.55, 0.50, 0.44};
constexpr Vec3 concrete_rgb{0.45, 0.45, 0.43};
constexpr Vec3 woods_rgb[] = {{0.56, 0.40, 0.25}, {0.64, 0.50, 0.34}};
constexpr Vec3 metal_rgb{0.52, 0.53, 0.54};
constexpr Vec3 textiles_rgb[] = {
    {0.55, 0.12, 0.10}, {0.12, 0.24, 0.46}, {0.22, 0.38, 0.16}, {0.60, 0.42, 0.10}};
constexpr Vec3 plastic_rgb{0.22, 0.22, 0.23};
constexpr Vec3 screen_rgb{0.06, 0.07, 0.08};
constexpr Vec3 glass_rgb{0.10, 0.11, 0.12};
constexpr Vec3 leaves_rgb{0.14, 0.34, 0.10};
constexpr Vec3 pictures_rgb[] = {{0.62, 0.50, 0.22}, {0.20, 0.40, 0.58}, {0.58, 0.24, 0.30}};
constexpr Vec3 lamp_rgb{0.80, 0.80, 0.80};

Vec3 one_of(std::span<const Vec3> list, unsigned variant) { return list[variant % list.size()]; }

Vec3 rgb_of(const Finish& finish) {
  switch (finish.material) {
    case Material::ceiling:
      return ceiling_rgb;
    case Material::wall:
      return one_of(walls_rgb, finish.variant);
    case Material::floor:
      return one_of(floors_rgb, finish.variant);
    case Material::corridor_floor:
      return corridor_floor_rgb;
    case Material::facade:
      return facade_rgb;
    case Material::concrete:
      return concrete_rgb;
    case Material::wood:
      return one_of(woods_rgb, finish.variant);
    case Material::metal:
      return metal_rgb;
    case Material::textile:
      return one_of(textiles_rgb, finish.variant);
    case Material::plastic:
      return plastic_rgb;
    case Material::screen:
      return screen_rgb;
    case Material::glass:
      return glass_rgb;
    case Material::leaves:
      return leaves_rgb;
    case Material::picture:
      return one_of(pictures_rgb, finish.variant);
    case Material::lamp:
      return lamp_rgb;
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
