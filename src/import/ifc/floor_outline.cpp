#include "import/ifc/floor_outline.hpp"

#include <cmath>

#include "geometry/geos.hpp"

namespace enfilade {
namespace {

/// Corners that are closer than this are one: models of buildings are rounded to 0.1 mm or 1 mm.
constexpr double same_m = 2e-4;

double signed_area(const std::vector<Vec2>& ring) {
  double twice = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i)
    twice += cross2(ring[i], ring[(i + 1) % ring.size()]);
  return 0.5 * twice;
}

std::vector<Vec2> ring_of(const Geos& geos, const GEOSGeometry* polygon) {
  std::vector<Vec2> ring;
  const GEOSGeometry* outer = GEOSGetExteriorRing_r(geos.handle(), polygon);
  const GEOSCoordSequence* points =
      outer == nullptr ? nullptr : GEOSGeom_getCoordSeq_r(geos.handle(), outer);
  unsigned size = 0;
  if (points == nullptr || GEOSCoordSeq_getSize_r(geos.handle(), points, &size) != 1) return ring;
  for (unsigned i = 0; i + 1 < size; ++i) {  // the last repeats the first
    Vec2 p;
    GEOSCoordSeq_getXY_r(geos.handle(), points, i, &p.x, &p.y);
    ring.push_back(p);
  }
  return ring;
}

/// Without points that repeat their neighbour, nor such on a straight line between theirs.
std::vector<Vec2> straightened(std::vector<Vec2> ring) {
  for (std::size_t i = 0; i < ring.size();) {
    if (glm::length(ring[(i + 1) % ring.size()] - ring[i]) < same_m)
      ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(i));
    else
      ++i;
  }
  std::vector<Vec2> kept;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2& before = kept.empty() ? ring.back() : kept.back();
    const Vec2 way = ring[(i + 1) % ring.size()] - before;
    if (std::abs(cross2(way, ring[i] - before)) > same_m * glm::length(way))
      kept.push_back(1e-4 * glm::round(1e4 * ring[i]));
  }
  return kept;
}

}  // namespace

std::vector<Vec2> floor_outline(const std::vector<Vec2>& corners) {
  const Geos geos;
  std::vector<GEOSGeometry*> triangles;
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
    std::vector<Vec2> ring{corners[i], corners[i + 1], corners[i + 2]};
    if (std::abs(signed_area(ring)) < 1e-8) continue;
    if (Geos::Geometry triangle = geos.polygon(ring)) triangles.push_back(triangle.release());
  }
  if (triangles.empty()) return {};
  // A little wider, so that neighbours whose corners were rounded apart grow together; then back.
  const auto wider = [&](const GEOSGeometry* g, double by) {
    return geos.own(g == nullptr ? nullptr
                                 : GEOSBufferWithStyle_r(geos.handle(), g, by, 8, GEOSBUF_CAP_FLAT,
                                                         GEOSBUF_JOIN_MITRE, 5.0));
  };
  const Geos::Geometry all = geos.own(GEOSGeom_createCollection_r(
      geos.handle(), GEOS_MULTIPOLYGON, triangles.data(), static_cast<unsigned>(triangles.size())));
  const Geos::Geometry grown = wider(all.get(), same_m);
  const Geos::Geometry whole = wider(grown.get(), -same_m);
  std::vector<Vec2> largest;
  const int count = whole ? GEOSGetNumGeometries_r(geos.handle(), whole.get()) : 0;
  for (int i = 0; i < count; ++i) {
    std::vector<Vec2> ring = ring_of(geos, GEOSGetGeometryN_r(geos.handle(), whole.get(), i));
    if (std::abs(signed_area(ring)) > std::abs(signed_area(largest))) largest = std::move(ring);
  }
  if (signed_area(largest) < 0.0) std::reverse(largest.begin(), largest.end());
  return straightened(largest);
}

}  // namespace enfilade
