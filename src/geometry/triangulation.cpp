#include "geometry/triangulation.hpp"

#include <cmath>
#include <map>
#include <utility>

#include "base/error.hpp"
#include "geometry/geos.hpp"

namespace enfilade {
namespace {

double signed_area(const std::vector<Vec2>& ring) {
  double twice = 0.0;
  for (std::size_t i = 2; i < ring.size(); ++i) {
    twice += cross2(ring[i - 1] - ring[0], ring[i] - ring[0]);
  }
  return 0.5 * twice;
}

// Collects triangles; a point keeps the number that it has in the ring.
class Collector {
 public:
  Collector(const Geos& geos, const std::vector<Vec2>& ring) : geos_(geos) {
    for (const Vec2& p : ring) result_.points.push_back(p);
    for (std::size_t i = ring.size(); i-- > 0;) {
      numbers_[{ring[i].x, ring[i].y}] = static_cast<std::uint32_t>(i);
    }
  }

  void add(const GEOSGeometry* triangles) {
    const int count = GEOSGetNumGeometries_r(geos_.handle(), triangles);
    for (int i = 0; i < count; ++i) add_triangle(GEOSGetGeometryN_r(geos_.handle(), triangles, i));
  }
  Triangulation take() { return std::move(result_); }

 private:
  void add_triangle(const GEOSGeometry* triangle) {
    const GEOSGeometry* ring = GEOSGetExteriorRing_r(geos_.handle(), triangle);
    const GEOSCoordSequence* points =
        ring == nullptr ? nullptr : GEOSGeom_getCoordSeq_r(geos_.handle(), ring);
    if (points == nullptr) return;
    std::array<std::uint32_t, 3> corner{};
    std::vector<Vec2> at(3);
    for (unsigned i = 0; i < 3; ++i) {
      GEOSCoordSeq_getXY_r(geos_.handle(), points, i, &at[i].x, &at[i].y);
      corner[i] = number(at[i]);
    }
    const double area = signed_area(at);
    if (area < 0.0) std::swap(corner[1], corner[2]);
    if (area != 0.0) result_.triangles.push_back(corner);
  }

  std::uint32_t number(const Vec2& p) {
    const auto [it, is_new] =
        numbers_.try_emplace({p.x, p.y}, static_cast<std::uint32_t>(result_.points.size()));
    if (is_new) result_.points.push_back(p);
    return it->second;
  }

  const Geos& geos_;
  Triangulation result_;
  std::map<std::pair<double, double>, std::uint32_t> numbers_;
};

}  // namespace

Triangulation triangulate(const std::vector<Vec2>& ring, double area_tolerance) {
  Triangulation crossing;
  crossing.simple = false;
  const Geos geos;
  Geos::Geometry polygon = geos.polygon(ring);
  if (!polygon) return crossing;
  if (GEOSisValid_r(geos.handle(), polygon.get()) != 1) {
    polygon = geos.own(GEOSMakeValid_r(geos.handle(), polygon.get()));
    double area = 0.0;
    if (!polygon || GEOSArea_r(geos.handle(), polygon.get(), &area) != 1) return crossing;
    if (std::abs(area - signed_area(ring)) > area_tolerance) return crossing;
  }
  const auto triangles =
      geos.own(GEOSConstrainedDelaunayTriangulation_r(geos.handle(), polygon.get()));
  if (!triangles) return crossing;
  Collector collector(geos, ring);
  collector.add(triangles.get());
  return collector.take();
}

}  // namespace enfilade
