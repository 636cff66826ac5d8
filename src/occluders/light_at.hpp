// What a light brings to a point, with the shadows between.
#pragma once

#include "base/work_count.hpp"
#include "light_parts/light_part.hpp"
#include "occluders/occluders.hpp"

namespace enfilade {

/// A place with a unit normal; `own`: the polygon that it lies on, which hides nothing.
struct LitPlace {
  Vec3 x{0.0}, n{0.0, 0.0, 1.0};
  std::uint32_t own = RayScene::no_polygon;
  RayStart start = RayStart::on_polygon;
};

/// Irradiance per unit of the light's mean intensity, 1/m2.
struct LightAtPoint {
  double irradiance = 0.0;
  double error = 0.0;          ///< estimated: by an opening that is near, and by its shadows
  std::vector<double> tint{};  ///< per band, of what passes panes (Passage::tint)

  /// Of what arrives in band b.
  double band(std::size_t b) const {
    return tint.empty() ? irradiance : irradiance * tint[b % tint.size()];
  }
};

/// Of a point light in closed form with one ray; of an opening by quadrature over what the place
/// sees of it, cut out exactly where few polygons stand before a part of it, else by points on it,
/// each with a ray. Counts rays in `work` unless that is null.
LightAtPoint light_at(const LightSource& light, const LitPlace& place, const Occluders& occluders,
                      WorkCount* work = nullptr);
/// An estimate without bias by one point of the opening at random (r1 and r2 in [0, 1)).
LightAtPoint light_by_one_ray(const LightSource& light, const LitPlace& place,
                              const Occluders& occluders, double r1, double r2);

}  // namespace enfilade
