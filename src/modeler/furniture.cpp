#include "modeler/furniture.hpp"

namespace enfilade {
namespace {

constexpr double glide_m = 0.01;  // under feet, and between parts

// A box whose underside emits.
void add_lit_box(SurfaceSink& sink, const Frame& f, const Vec3& lo, const Vec3& hi) {
  const Finish lamp{Material::lamp, 0};
  const auto side = [&](Vec2 a, Vec2 b) {
    sink.add(
        {f.at(a.x, a.y, lo.z), f.at(b.x, b.y, lo.z), f.at(b.x, b.y, hi.z), f.at(a.x, a.y, hi.z)},
        lamp, "housing");
  };
  sink.add_light({f.at(lo.x, lo.y, lo.z), f.at(lo.x, hi.y, lo.z), f.at(hi.x, hi.y, lo.z),
                  f.at(hi.x, lo.y, lo.z)},
                 lamp, "light");
  sink.add({f.at(lo.x, lo.y, hi.z), f.at(hi.x, lo.y, hi.z), f.at(hi.x, hi.y, hi.z),
            f.at(lo.x, hi.y, hi.z)},
           lamp, "housing");
  side({lo.x, lo.y}, {hi.x, lo.y});
  side({hi.x, lo.y}, {hi.x, hi.y});
  side({hi.x, hi.y}, {lo.x, hi.y});
  side({lo.x, hi.y}, {lo.x, lo.y});
}

void add_lamp(SurfaceSink& sink, const Frame& f) {
  add_lit_box(sink, f, {0.0, 0.0, -0.14}, {1.2, 0.3, -0.09});
}

void add_desk(SurfaceSink& sink, const Frame& f, unsigned variant) {
  const Finish wood{Material::wood, variant};
  add_box(sink, f, {0.0, 0.0, desk_height_m - 0.03}, {1.3, 0.7, desk_height_m}, wood, "top");
  const double under = desk_height_m - 0.03 - glide_m;
  add_box(sink, f, {0.05, 0.05, glide_m}, {0.08, 0.65, under}, {Material::metal}, "side");
  add_box(sink, f, {1.22, 0.05, glide_m}, {1.25, 0.65, under}, {Material::metal}, "side");
}

void add_chair(SurfaceSink& sink, const Frame& f, unsigned variant) {
  const Finish cloth{Material::textile, variant}, metal{Material::metal};
  add_box(sink, f, {0.0, 0.03, glide_m}, {0.02, 0.45, 0.43 - glide_m}, metal, "side");
  add_box(sink, f, {0.43, 0.03, glide_m}, {0.45, 0.45, 0.43 - glide_m}, metal, "side");
  add_box(sink, f, {0.0, 0.0, 0.43}, {0.45, 0.45, 0.47}, cloth, "seat");
  add_box(sink, f, {0.0, 0.0, 0.52}, {0.45, 0.03, 0.88}, cloth, "back");
}

void add_table(SurfaceSink& sink, const Frame& f, unsigned variant) {
  const Finish metal{Material::metal};
  add_box(sink, f, {0.15, 0.15, glide_m}, {0.55, 0.55, 0.03}, metal, "foot");
  add_box(sink, f, {0.31, 0.31, 0.03 + glide_m}, {0.39, 0.39, 0.7 - glide_m}, metal, "column");
  add_box(sink, f, {0.0, 0.0, 0.7}, {0.7, 0.7, 0.73}, {Material::wood, variant}, "top");
}

void add_shelf(SurfaceSink& sink, const Frame& f, unsigned variant) {
  const Finish wood{Material::wood, variant};
  add_box(sink, f, {0.0, 0.0, glide_m}, {0.02, 0.4, 1.25}, wood, "side");
  add_box(sink, f, {0.78, 0.0, glide_m}, {0.8, 0.4, 1.25}, wood, "side");
  add_box(sink, f, {0.03, 0.0, 0.1}, {0.77, 0.01, 1.25}, wood, "back");
  for (const double z : {0.15, 0.65}) {
    add_box(sink, f, {0.03, 0.02, z}, {0.77, 0.38, z + 0.02}, wood, "board");
  }
}

void add_monitor(SurfaceSink& sink, const Frame& f) {
  add_box(sink, f, {0.15, 0.0, glide_m}, {0.35, 0.16, 0.03}, {Material::plastic}, "foot");
  add_box(sink, f, {0.0, 0.06, 0.12}, {0.5, 0.09, 0.42}, {Material::screen}, "screen");
}

void add_desk_lamp(SurfaceSink& sink, const Frame& f) {
  add_box(sink, f, {0.0, 0.0, glide_m}, {0.12, 0.12, 0.03}, {Material::metal}, "foot");
  add_box(sink, f, {0.05, 0.05, 0.04}, {0.07, 0.07, 0.39}, {Material::metal}, "stem");
  add_lit_box(sink, f, {0.02, -0.15, 0.4}, {0.1, 0.1, 0.43});
}

// A pot, and an octahedron for the crown.
void add_plant(SurfaceSink& sink, const Frame& f) {
  add_prism(sink, f, 5, 0.14, glide_m, 0.3, {Material::concrete}, "pot");
  const Vec3 foot = f.at(0, 0, 0.32), tip = f.at(0, 0, 1.2);
  const Vec3 ring[] = {f.at(0.2, 0, 0.7), f.at(0, 0.2, 0.7), f.at(-0.2, 0, 0.7),
                       f.at(0, -0.2, 0.7)};
  for (int i = 0; i < 4; ++i) {
    const Vec3 &a = ring[i], &b = ring[(i + 1) % 4];
    sink.add({a, b, tip}, {Material::leaves}, "crown");
    sink.add({b, a, foot}, {Material::leaves}, "crown");
  }
}

}  // namespace

Vec2 footprint_m(FurnitureKind kind) {
  switch (kind) {
    case FurnitureKind::lamp:
      return {1.2, 0.3};
    case FurnitureKind::desk:
      return {1.3, 0.7};
    case FurnitureKind::chair:
      return {0.45, 0.45};
    case FurnitureKind::table:
      return {0.7, 0.7};
    case FurnitureKind::shelf:
    case FurnitureKind::cupboard:
      return {0.8, 0.4};
    case FurnitureKind::bin:
      return {0.28, 0.28};
    case FurnitureKind::plant:
      return {0.4, 0.4};
    case FurnitureKind::monitor:
      return {0.5, 0.16};
    case FurnitureKind::desk_lamp:
      return {0.12, 0.25};
    case FurnitureKind::picture:
      return {0.7, 0.05};
  }
  return Vec2(0.0);
}

void add_furniture(SurfaceSink& sink, FurnitureKind kind, const Frame& f, unsigned variant) {
  switch (kind) {
    case FurnitureKind::lamp:
      return add_lamp(sink, f);
    case FurnitureKind::desk:
      return add_desk(sink, f, variant);
    case FurnitureKind::chair:
      return add_chair(sink, f, variant);
    case FurnitureKind::table:
      return add_table(sink, f, variant);
    case FurnitureKind::shelf:
      return add_shelf(sink, f, variant);
    case FurnitureKind::cupboard:
      return add_box(sink, f, {0.0, 0.0, 0.05}, {0.8, 0.4, 1.2}, {Material::wood, variant + 1},
                     "cupboard");
    case FurnitureKind::bin:
      return add_prism(sink, f, 6, 0.14, glide_m, 0.35, {Material::plastic}, "bin");
    case FurnitureKind::plant:
      return add_plant(sink, f);
    case FurnitureKind::monitor:
      return add_monitor(sink, f);
    case FurnitureKind::desk_lamp:
      return add_desk_lamp(sink, f);
    case FurnitureKind::picture:
      return add_box(sink, f, {0.0, 0.02, 1.45}, {0.7, 0.05, 1.95}, {Material::picture, variant},
                     "picture");
  }
}

int surfaces_of(FurnitureKind kind) {
  int count = 0;
  SurfaceSink counter({}, [&](const Surface&) { ++count; });
  add_furniture(counter, kind, {}, 0);
  return count;
}

bool is_light(FurnitureKind kind) {
  return kind == FurnitureKind::lamp || kind == FurnitureKind::desk_lamp;
}

}  // namespace enfilade
