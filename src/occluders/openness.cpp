#include "occluders/openness.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/random.hpp"

namespace enfilade {

EnclosedShare enclosed_share(const ClusterState& cluster, const PatchNode& node, int rings,
                             const Occluders& occluders, const EndsRay& ends, WorkCount& work) {
  const PolygonFrame& frame = cluster.patches().frames()[node.id.root];
  const std::uint32_t own = occluders.global(cluster.id(), node.id.root);
  Random random((std::uint64_t{own} << 32) + node.id.path);
  // Where another polygon meets the patch's rim, a ray that starts on the rim would pass behind it.
  const double size_m = std::sqrt(node.shape.area_m2);
  const double inside = 1.0 - std::clamp(8.0 * occluders.rays().epsilon_m() / size_m, 1e-3, 0.5);
  double ended = 0.0;
  int pending = 0;
  const auto counts = [&](std::uint32_t polygon) {
    const bool it_does = ends(occluders.local(polygon));
    pending += it_does ? 0 : 1;
    return it_does;
  };
  for (int quarter = 0; quarter < 4; ++quarter) {
    for (int stratum = 0; stratum < rings * rings; ++stratum) {
      const Vec2 any = node.shape.point_in_quarter(quarter, random.uniform(), random.uniform());
      const Vec2 q = node.shape.centroid + inside * (any - node.shape.centroid);
      const double r = std::sqrt((stratum / rings + random.uniform()) / rings);
      const double phi = 2.0 * std::numbers::pi * (stratum % rings + random.uniform()) / rings;
      const Vec3 d = r * std::cos(phi) * frame.u + r * std::sin(phi) * frame.v +
                     std::sqrt(std::max(0.0, 1.0 - r * r)) * frame.n;
      ++work.rays;
      const Vec3 x = frame.at(q);
      const RayHit hit = occluders.rays().closest(x, d, own);
      double passing = 1.0;
      if (occluders.panes().any()) {
        const auto met = occluders.panes_along(x, d, hit.any() ? hit.distance_m : far_away_m, own);
        for (const PaneMet& pane : met)
          ended += pane.front && counts(pane.polygon) ? pane.before.share : 0.0;
        if (!met.empty()) passing = met.back().behind.share;
      }
      if (hit.any() && hit.front && counts(hit.polygon)) ended += passing;
    }
  }
  const double rays = 4.0 * rings * rings;
  return {ended / rays, pending / rays};
}

}  // namespace enfilade
