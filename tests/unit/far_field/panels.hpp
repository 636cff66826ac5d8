// A building of separate panels in the open, each a cluster of its own, all in one cell.
#pragma once

#include "hierarchy/cluster_state.hpp"

namespace enfilade::testing {

struct Panel {
  Vec3 corner, u, v;  ///< the front is along cross(u, v)
  double exitance = 0.0;
};

struct Panels {
  Scene scene;
  std::vector<Cluster> clusters;

  explicit Panels(std::span<const Panel> panels) {
    scene.bands = 1;
    for (const Panel& p : panels) {
      Surface surface;
      surface.vertices = {p.corner, p.corner + p.u, p.corner + p.u + p.v, p.corner + p.v};
      surface.reflectance = {0.5};
      surface.exitance = {p.exitance};
      Cluster cluster;
      cluster.id = ClusterId(clusters.size());
      cluster.cell = CellId(0u);
      cluster.polygons.push_back({SurfaceId(clusters.size()), surface.vertices});
      cluster.area_m2 = area_m2(surface.vertices);
      cluster.bounds = bounds(surface.vertices);
      clusters.push_back(std::move(cluster));
      scene.surfaces.push_back(std::move(surface));
    }
  }
};

/// Panels of 1 m2 and more that face up, down, and along x, of differing exitance.
inline std::vector<Panel> mixed_panels() {
  std::vector<Panel> panels;
  for (int i = 0; i < 4; ++i) {
    const double x = 3.0 * i;
    panels.push_back({{x, 0, 0}, {1.0 + i, 0, 0}, {0, 1, 0}, 1.0 + i});  // up
    panels.push_back({{x, 3, 0}, {0, 1, 0}, {1, 0, 0}, 10.0 * i});       // down
    panels.push_back({{x, 6, 0}, {0, 1, 0}, {0, 0, 2}, 0.5});            // along +x
  }
  return panels;
}

}  // namespace enfilade::testing
