// From surfaces as read to the convex pieces that the solver works on.
#include <cmath>
#include <cstdio>

#include "base/error.hpp"
#include "scene/convex_parts.hpp"
#include "scene/coplanar.hpp"
#include "scene/facing.hpp"
#include "scene/scene_limits.hpp"

namespace enfilade {
namespace {

std::string with_area(std::string where, double area_m2) {
  char text[32];
  std::snprintf(text, sizeof text, " (%.4g m2)", area_m2);
  return where + text;
}

// Convex parts of one surface; adds the warnings about its shape.
std::vector<Polygon> parts_of(const Scene& scene, SurfaceId id, const SceneScale& scale,
                              Warnings& warnings, PieceReport& report) {
  ConvexParts found = convex_parts(scene.surfaces[id.index()].vertices, scale);
  switch (found.shape) {
    case PolygonShape::convex:
      break;
    case PolygonShape::degenerate:
      ++report.dropped;
      warnings.add(label(scene, id), "no area to speak of (point, line or sliver): dropped");
      break;
    case PolygonShape::non_planar:
      ++report.split;
      warnings.add(label(scene, id), "not planar: split into planar parts");
      break;
    case PolygonShape::non_convex:
      ++report.split;
      warnings.add(label(scene, id), "not convex: split into convex parts");
      break;
    case PolygonShape::self_intersecting:
      throw InputError(scene.file, label(scene, id) + ".vertices", "the polygon crosses itself",
                       "put its vertices in order around the outline, or split it");
  }
  return std::move(found.parts);
}

void warn_covered(const Scene& scene, const std::vector<Piece>& before, const Covered& covered,
                  const SceneScale& scale, Warnings& warnings, PieceReport& report) {
  std::size_t covered_surfaces = 0;
  for (std::size_t i = 0; i < before.size();) {
    // All pieces of one surface give one warning.
    const SurfaceId id = before[i].surface;
    double area = 0.0, all = 0.0;
    bool duplicate = true;
    for (; i < before.size() && before[i].surface == id; ++i) {
      area += covered.area_m2[i];
      all += area_m2(before[i].polygon);
      duplicate = duplicate && covered.duplicate[i];
    }
    if (area <= scale.cut() * std::sqrt(all)) continue;
    ++covered_surfaces;
    report.covered_area_m2 += area;
    report.dropped += duplicate ? 1 : 0;
    warnings.add(
        with_area(label(scene, id), area),
        duplicate ? "same outline and material as an earlier surface: dropped"
                  : "covered by a surface in the same plane in front of it: covered part left out");
  }
  if (covered_surfaces > 1) {
    warnings.add(with_area("surfaces in one plane", report.covered_area_m2),
                 "covered area left out in all");
  }
}

}  // namespace

std::vector<Piece> make_pieces(const Scene& scene, Warnings& warnings, PieceReport* report) {
  check_limits(scene);
  const SceneScale scale(scene);
  PieceReport counts;
  std::vector<Piece> pieces;
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
    const SurfaceId id(s);
    std::vector<Polygon> parts = parts_of(scene, id, scale, warnings, counts);
    for (const Polygon& part : parts) pieces.push_back({id, part});
    if (!scene.surfaces[s].two_sided) continue;
    for (const Polygon& part : parts)
      pieces.push_back({id, Polygon(part.rbegin(), part.rend()), true});
  }
  if (pieces.empty()) {
    throw InputError(scene.file, "surfaces", "none has an area to speak of",
                     "check the vertices and the unit of length");
  }
  const std::vector<Piece> before = pieces;
  const Covered covered = cut_covered(pieces, scene, scale);
  warn_covered(scene, before, covered, scale, warnings, counts);
  for (const SurfaceId id : reversed_surfaces(scene, scale)) {
    warnings.add(label(scene, id),
                 "faces the other way than its neighbours: its black back is seen; "
                 "reverse the order of its vertices if that is not meant");
  }
  if (report != nullptr) *report = counts;
  return pieces;
}

}  // namespace enfilade
