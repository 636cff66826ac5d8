// Parts of a light's opening: the nodes that a light is refined by.
#pragma once

#include <boost/container/small_vector.hpp>

#include "hierarchy/patch_forest.hpp"
#include "scene/light.hpp"

namespace enfilade {

/// A point of a light and its share of the light's flux.
struct LightPoint {
  Vec3 y{0.0};
  double share = 1.0;
};

/// A light, or the part of it that a path names: as of a patch, the first bits choose among the
/// polygons of its opening, halving their list, the further ones halve the polygon's patches.
struct LightPart {
  const LightSource* light = nullptr;
  std::uint32_t first = 0, last = 0;  ///< polygons of the opening
  PolygonFrame frame{};               ///< of a part of one polygon
  PatchShape shape{};                 ///< of a part of one polygon
  double share = 1.0;                 ///< of the light's flux
  Vec3 center{0.0};
  double radius = 0.0;  ///< of a ball around the centre that contains it, metres

  static LightPart whole(const LightSource& light);
  static LightPart of(const LightSource& light, std::uint32_t path);
  LightPart half(int side) const;

  bool is_point() const { return light->opening.empty(); }
  bool is_one_polygon() const { return last == first + 1; }
  /// Returns the points that stand for it: of one polygon four, exact for light that varies as a
  /// cubic; of several the centroid of each.
  boost::container::small_vector<LightPoint, 6> points() const;
  /// Returns corners whose convex hull contains it.
  Polygon corners() const;
  /// Returns a point of quarter 0 .. 3 for r1 and r2 in [0, 1), as PatchShape::point_in_quarter.
  Vec3 point_in_quarter(int quarter, double r1, double r2) const;

 private:
  void measure();
};

/// Irradiance (1/m2) per unit of a light's mean intensity.
struct LightKernel {
  double at = 0.0;      ///< by the part's points
  double spread = 0.0;  ///< estimated error: the light between the points
};
/// Returns what arrives at x with unit normal n from the whole part, as if nothing stood between.
LightKernel kernel_of(const LightPart& part, const Vec3& x, const Vec3& n);
/// The same from one point y of it, with all of its flux.
double kernel_from(const LightSource& light, const Vec3& y, const Vec3& x, const Vec3& n);
/// Returns the integral of that over a convex polygon with unit normal n (no unit): exact for each
/// of the part's points.
double power_onto(const LightPart& part, std::span<const Vec3> polygon, const Vec3& n);

}  // namespace enfilade
