#include "report/plans/plan_marks.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/clip.hpp"
#include "report/plans/level_section.hpp"
#include "report/plans/plan_outline.hpp"

namespace enfilade {

namespace {

/// Floors are this thick at most: openings in them belong to the storeys above and below.
constexpr double slab_m = 0.6;

/// Parallel lines across a convex polygon seen from above, at 45 degrees, on a lattice of the
/// world so that openings side by side go on into each other.
std::vector<Path> hatch(const Polygon& polygon, double step_m) {
  const Vec2 across = Vec2(1.0, -1.0) / std::sqrt(2.0);
  const auto offset = [&](const Vec3& p) { return glm::dot(Vec2(p), across); };
  double lo = offset(polygon[0]), hi = lo;
  for (const Vec3& p : polygon) lo = std::min(lo, offset(p)), hi = std::max(hi, offset(p));
  std::vector<Path> lines;
  for (double at = std::ceil(lo / step_m) * step_m; at < hi; at += step_m) {
    Path ends;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec2 a(polygon[i]), b(polygon[(i + 1) % polygon.size()]);
      const double from = glm::dot(a, across) - at, to = glm::dot(b, across) - at;
      if ((from < 0.0) != (to < 0.0)) ends.push_back(zero_crossing(a, from, b, to));
    }
    if (ends.size() == 2) lines.push_back(std::move(ends));
  }
  return lines;
}

std::vector<Path> dashes(const Vec2& a, const Vec2& b, double step_m) {
  const auto count = static_cast<int>(std::ceil(glm::length(b - a) / (2.0 * step_m)));
  std::vector<Path> lines;
  for (int i = 0; i < count; ++i) {
    const double from = (i + 0.25) / count, to = (i + 0.75) / count;
    lines.push_back({a + from * (b - a), a + to * (b - a)});
  }
  return lines;
}

/// The line that an upright polygon leaves on the ground.
std::pair<Vec2, Vec2> ground_line(const Polygon& polygon) {
  const Vec3 n = normal(polygon);
  const Vec2 along(-n.y, n.x);
  const auto less = [&](const Vec3& a, const Vec3& b) {
    return glm::dot(Vec2(a), along) < glm::dot(Vec2(b), along);
  };
  const auto [lo, hi] = std::minmax_element(polygon.begin(), polygon.end(), less);
  return {Vec2(*lo), Vec2(*hi)};
}

/// How the storey's plan shows a portal; false: it does not.
bool set_view(PortalMark& mark, const Polygon& polygon, const PlanCut& cut, double step_m) {
  const Box box = bounds(polygon);
  const double floor_m = cut.storey.floor_m, ceiling_m = floor_m + cut.storey.headroom_m;
  if (std::abs(normal(polygon).z) > 0.7) {
    if (box.hi.z < floor_m - slab_m || box.lo.z > ceiling_m + slab_m) return false;
    mark.view = PortalView::level;
    mark.lines = hatch(polygon, step_m);
    Path edge(polygon.begin(), polygon.end());
    edge.push_back(edge.front());
    mark.lines.push_back(std::move(edge));
  } else if (const auto line = level_cut(polygon, cut.z_m)) {
    mark.lines = {{Vec2(line->first), Vec2(line->second)}};
  } else {
    if (box.hi.z < floor_m + 0.05 || box.lo.z > ceiling_m - 0.05) return false;
    mark.view = PortalView::beyond;
    const auto [a, b] = ground_line(polygon);
    mark.lines = dashes(a, b, step_m);
  }
  return !mark.lines.empty();
}

}  // namespace

std::vector<PortalMark> portal_marks(const CellComplex& complex, const PlanCut& cut,
                                     double step_m) {
  std::vector<PortalMark> marks;
  const auto kind = [&](CellId cell) { return complex.cells()[cell.index()].kind; };
  const auto either = [&](const Portal& portal, CellKind wanted) {
    return kind(portal.a) == wanted || kind(portal.b) == wanted;
  };
  for (const Portal& portal : complex.portals()) {
    PortalMark mark;
    mark.id = portal.id;
    if (either(portal, CellKind::solid)) {
      mark.side = PortalSide::solid;
    } else if (either(portal, CellKind::outside)) {
      mark.side = PortalSide::outside;
    }
    if (set_view(mark, portal.polygon, cut, step_m)) marks.push_back(std::move(mark));
  }
  return marks;
}

std::vector<ClusterMark> cluster_marks(std::span<const Cluster> clusters, const PlanCut& cut) {
  std::vector<ClusterMark> marks;
  const double floor_m = cut.storey.floor_m;
  for (const Cluster& cluster : clusters) {
    ClusterMark mark;
    mark.id = cluster.id;
    std::vector<Polygon> ground;
    for (const ClusterPolygon& p : cluster.polygons) {
      if (const auto line = level_cut(p.polygon, cut.z_m))
        mark.paths.push_back({Vec2(line->first), Vec2(line->second)});
      ground.push_back(p.polygon);
    }
    // Floors end below this; what hangs under a ceiling or starts a storey below is not here.
    const bool stands = cluster.bounds.lo.z > floor_m - 0.1 && cluster.bounds.hi.z > floor_m + 0.1;
    if (mark.paths.empty() && stands && cluster.bounds.hi.z < cut.z_m) {
      mark.below = true;
      mark.paths = footprint(ground);
    }
    if (!mark.paths.empty()) marks.push_back(std::move(mark));
  }
  return marks;
}

}  // namespace enfilade
