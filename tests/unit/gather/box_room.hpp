// Scenes that the radiosity tests build in code.
#pragma once

#include "coarse/coarse_system.hpp"
#include "gather/emitted_power.hpp"
#include "gather/gather.hpp"
#include "hierarchy/cluster_state.hpp"
#include "occluders/occluders.hpp"

namespace enfilade::testing {

/// The six inner faces of a box, with one reflectance and exitance for all.
inline Scene box_room(Vec3 lo, Vec3 hi, Spectrum reflectance, Spectrum exitance) {
  const auto corner = [&](int x, int y, int z) {
    return Vec3(x ? hi.x : lo.x, y ? hi.y : lo.y, z ? hi.z : lo.z);
  };
  const std::vector<Polygon> faces{
      {corner(0, 0, 0), corner(1, 0, 0), corner(1, 1, 0), corner(0, 1, 0)},   // floor
      {corner(0, 0, 1), corner(0, 1, 1), corner(1, 1, 1), corner(1, 0, 1)},   // ceiling
      {corner(0, 0, 0), corner(0, 1, 0), corner(0, 1, 1), corner(0, 0, 1)},   // x = lo
      {corner(1, 0, 0), corner(1, 0, 1), corner(1, 1, 1), corner(1, 1, 0)},   // x = hi
      {corner(0, 0, 0), corner(0, 0, 1), corner(1, 0, 1), corner(1, 0, 0)},   // y = lo
      {corner(0, 1, 0), corner(1, 1, 0), corner(1, 1, 1), corner(0, 1, 1)}};  // y = hi
  Scene scene;
  scene.bands = static_cast<int>(reflectance.size());
  for (const Polygon& face : faces) {
    Surface s;
    s.vertices = face;
    s.reflectance = reflectance;
    s.exitance = exitance;
    scene.surfaces.push_back(std::move(s));
  }
  return scene;
}

/// A solid block (faces outward) added to a scene.
inline void add_block(Scene& scene, Vec3 lo, Vec3 hi, Spectrum reflectance, Spectrum exitance) {
  Scene block = box_room(lo, hi, std::move(reflectance), std::move(exitance));
  for (Surface& s : block.surfaces) {
    std::reverse(s.vertices.begin(), s.vertices.end());
    s.object = "block";
    scene.surfaces.push_back(std::move(s));
  }
}

/// One cluster for each surface without an object, one for each object.
inline std::vector<Cluster> clusters_of(const Scene& scene) {
  std::vector<Cluster> clusters;
  for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
    const Surface& s = scene.surfaces[i];
    if (s.object.empty() || clusters.empty() || clusters.back().object != s.object) {
      Cluster c;
      c.id = ClusterId(clusters.size());
      c.cell = CellId(0u);
      c.object = s.object;
      clusters.push_back(c);
    }
    Cluster& c = clusters.back();
    c.polygons.push_back({SurfaceId(i), s.vertices});
    c.area_m2 += area_m2(s.vertices);
    for (const Vec3& v : s.vertices) c.bounds.add(v);
  }
  return clusters;
}

/// A whole solve on one rank with everything in memory; everything sees everything.
struct Solved {
  Scene scene;
  std::vector<Cluster> clusters;
  Occluders occluders;
  std::vector<ClusterState> states;
  int iterations = 0;
  double absorbed_share = 0.0;  // of band 0's emitted power
  std::size_t links = 0;
  IterationFigures figures;  ///< of the last iteration
  WorkCount work;

  Solved(Scene s, Basis basis, double epsilon, bool coarse = true, int most = 500,
         bool aggregates = true)
      : scene(std::move(s)), clusters(clusters_of(scene)), occluders(clusters) {
    const CoarseUnknowns unknowns = coarse_unknowns(clusters, aggregates ? 128 : 1);
    for (const Cluster& c : clusters) {
      states.emplace_back(c, scene, basis, unknowns.aggregates[c.id.index()]);
    }
    const Spectrum emitted = emitted_power(scene, clusters);
    GatherConfig config;
    std::vector<ClusterId> all;
    for (const Cluster& c : clusters) all.push_back(c.id);
    config.refinement.link_tolerance = epsilon * *std::max_element(emitted.begin(), emitted.end());
    config.refinement.min_area_m2 = 1e-8 * occluders.extent_m() * occluders.extent_m();
    const auto bands = static_cast<std::size_t>(scene.bands);
    for (iterations = 1; iterations <= most; ++iterations) {
      config.iteration = iterations;
      config.close_rows = iterations > 3;
      CoarseSystem system(unknowns.count, bands);
      double change = 0.0, received = 0.0, absorbed = 0.0;
      links = 0;
      figures = {};
      std::vector<ClusterState> committed;
      if (unknowns.aggregated()) committed = states;
      const std::vector<ClusterState>& light = unknowns.aggregated() ? committed : states;
      for (ClusterState& receiver : states) {
        const GatherResult r = gather(
            receiver, {all},
            [&light](ClusterId id) -> const ClusterState& { return light[id.index()]; },
            scene.lights, occluders, config);
        change += r.figures.change_power;
        received += r.figures.received_power;
        absorbed += r.figures.absorbed_power[0];
        work += r.figures.work;
        add(figures, r.figures);
        links += receiver.links().size();
        system.add(receiver.id(), r.coarse, unknowns);
      }
      absorbed_share = absorbed / emitted[0];
      double missing = 0.0;
      if (coarse && iterations > 1) {
        const std::vector<double> offsets = system.solve(unknowns).value();
        missing = system.power(offsets);
        for (ClusterState& s2 : states) {
          s2.correct(unknowns.of(s2.id(), offsets, bands));
        }
      }
      if (iterations > 4 && change + missing < 1e-6 * received) break;
    }
  }
};

}  // namespace enfilade::testing
