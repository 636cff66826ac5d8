#include "report/plans/plan_outline.hpp"

#include <cmath>

#include "geometry/geos.hpp"

namespace enfilade {

namespace {

/// Nothing where no polygon covers ground.
Geos::Geometry union_of(const Geos& geos, std::span<const Polygon> polygons, double snap_m = 0.0) {
  std::vector<GEOSGeometry*> parts;
  for (const Polygon& polygon : polygons) {
    if (std::abs(area_vector(polygon).z) < 1e-8) continue;
    const std::vector<Vec2> ring(polygon.begin(), polygon.end());
    if (Geos::Geometry part = geos.polygon(ring)) parts.push_back(part.release());
  }
  if (parts.empty()) return geos.own(nullptr);
  const auto all = geos.own(GEOSGeom_createCollection_r(
      geos.handle(), GEOS_MULTIPOLYGON, parts.data(), static_cast<unsigned>(parts.size())));
  auto outline = geos.own(!all           ? nullptr
                          : snap_m > 0.0 ? GEOSUnaryUnionPrec_r(geos.handle(), all.get(), snap_m)
                                         : GEOSUnaryUnion_r(geos.handle(), all.get()));
  // One order of rings, and holes that turn the other way.
  if (outline) GEOSNormalize_r(geos.handle(), outline.get());
  return outline;
}

std::vector<Vec2> points_of(const Geos& geos, const GEOSGeometry* line) {
  std::vector<Vec2> points;
  const GEOSCoordSequence* sequence = GEOSGeom_getCoordSeq_r(geos.handle(), line);
  unsigned count = 0;
  if (sequence == nullptr || GEOSCoordSeq_getSize_r(geos.handle(), sequence, &count) != 1)
    return {};
  points.resize(count);
  for (unsigned i = 0; i < count; ++i) {
    GEOSCoordSeq_getXY_r(geos.handle(), sequence, i, &points[i].x, &points[i].y);
  }
  return points;
}

void add_rings(const Geos& geos, const GEOSGeometry* polygon,
               std::vector<std::vector<Vec2>>& rings) {
  const auto add = [&](const GEOSGeometry* ring) {
    std::vector<Vec2> points = points_of(geos, ring);
    if (!points.empty()) points.pop_back();  // the first again
    if (points.size() >= 3) rings.push_back(std::move(points));
  };
  add(GEOSGetExteriorRing_r(geos.handle(), polygon));
  const int holes = GEOSGetNumInteriorRings_r(geos.handle(), polygon);
  for (int i = 0; i < holes; ++i) add(GEOSGetInteriorRingN_r(geos.handle(), polygon, i));
}

}  // namespace

std::vector<std::vector<Vec2>> footprint(std::span<const Polygon> polygons, double snap_m) {
  const Geos geos;
  std::vector<std::vector<Vec2>> rings;
  const auto all = union_of(geos, polygons, snap_m);
  if (!all) return rings;
  const int count = GEOSGetNumGeometries_r(geos.handle(), all.get());
  for (int i = 0; i < count; ++i) {
    const GEOSGeometry* part = GEOSGetGeometryN_r(geos.handle(), all.get(), i);
    if (GEOSGeomTypeId_r(geos.handle(), part) == GEOS_POLYGON) add_rings(geos, part, rings);
  }
  return rings;
}

InnerCircle largest_circle(std::span<const Polygon> polygons) {
  const Geos geos;
  const auto all = union_of(geos, polygons);
  Box box;
  for (const Polygon& polygon : polygons) box.add(bounds(polygon));
  if (!all || box.empty()) return {};
  const double step_m = 0.01 * std::min(box.extent().x, box.extent().y);
  if (step_m <= 0.0) return {};
  const auto radius = geos.own(GEOSMaximumInscribedCircle_r(geos.handle(), all.get(), step_m));
  const std::vector<Vec2> ends = radius ? points_of(geos, radius.get()) : std::vector<Vec2>{};
  if (ends.size() != 2) return {};
  return {ends[0], glm::length(ends[1] - ends[0])};
}

}  // namespace enfilade
