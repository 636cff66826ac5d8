// Two rooms in a row, each 4 m x 5 m x 3 m with walls 0.2 m thick between them and around, one lamp
// below each ceiling, and light that the tests choose.
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "report/pictures/solved_scene.hpp"
#include "unit/geometry/box_faces.hpp"

namespace enfilade::test {

struct LitRooms {
  Scene scene;
  CellComplex cells;
  std::vector<Cluster> clusters;
  std::vector<ClusterState> states;
  std::unique_ptr<Occluders> occluders;

  /// `rooms` rooms along x, in cells 0, 1, ..; the shell around them is in no cell. Surfaces per
  /// room: floor, ceiling, four walls, lamp.
  explicit LitRooms(int rooms = 1, int bands = 1, Basis basis = Basis::linear) {
    scene.bands = bands;
    scene.unit = ExitanceUnit::lumen_per_m2;
    for (int r = 0; r < rooms; ++r) add_room(r);
    add_cluster(CellId(), box_faces({-0.2, -0.2, -0.2}, {rooms * 4.2, 5.2, 3.2}, false), "shell");
    add_cells(rooms);
    for (const Cluster& c : clusters) states.emplace_back(c, scene, basis);
    occluders = std::make_unique<Occluders>(clusters);
    set_irradiance([](const Vec3&) { return 0.0; });
  }
  SolvedScene solved() const { return {scene, cells, clusters, states, *occluders}; }

  /// Subdivides what is larger than `area_m2`.
  void subdivide(double area_m2) {
    for (ClusterState& s : states) {
      for (std::size_t i = 0; i < s.patches().size(); ++i) {
        if (s.patches().node(i).leaf() && s.patches().node(i).shape.area_m2 > area_m2)
          s.patches().subdivide(i);
      }
    }
  }
  /// Irradiance of each leaf = `light` at its centroid, in all bands, with its gradient where the
  /// basis has one; the shell gets none.
  void set_irradiance(const std::function<double(const Vec3&)>& light) {
    for (ClusterState& s : states) {
      PatchForest& f = s.patches();
      const std::size_t terms = static_cast<std::size_t>(f.terms()),
                        bands = static_cast<std::size_t>(f.bands());
      std::vector<double> gathered(f.size() * bands * terms, 0.0);
      for (std::size_t i = 0; s.cell().valid() && i < f.size(); ++i) {
        if (!f.node(i).leaf()) continue;
        const PolygonFrame& frame = f.frames()[f.node(i).id.root];
        const Vec3 p = frame.at(f.node(i).shape.centroid);
        for (std::size_t b = 0; b < bands; ++b) {
          double* e = &gathered[(i * bands + b) * terms];
          e[0] = light(p);
          if (terms != 3) continue;
          e[1] = (light(p + 0.01 * frame.u) - light(p - 0.01 * frame.u)) / 0.02;
          e[2] = (light(p + 0.01 * frame.v) - light(p - 0.01 * frame.v)) / 0.02;
        }
      }
      f.push_pull(gathered);
    }
  }

 private:
  void add_room(int r) {
    const double x = 4.2 * r;
    add_cluster(CellId(r), box_faces({x, 0, 0}, {x + 4, 5, 3}, true), "room " + std::to_string(r));
    const double z = 2.9;  // the lamp hangs below the ceiling and looks down
    add_cluster(CellId(r), {{{x + 1.5, 2, z}, {x + 1.5, 3, z}, {x + 2.5, 3, z}, {x + 2.5, 2, z}}},
                "lamp " + std::to_string(r), 100.0);
  }
  void add_cluster(CellId cell, const std::vector<Polygon>& faces, const std::string& object,
                   double exitance = 0.0) {
    Cluster cluster;
    cluster.id = ClusterId(clusters.size());
    cluster.cell = cell;
    cluster.object = object;
    const std::size_t bands = static_cast<std::size_t>(scene.bands);
    for (const Polygon& face : faces) {
      Surface surface;
      surface.vertices = face;
      surface.reflectance = Spectrum(bands, exitance > 0.0 ? 0.0 : 0.5);
      surface.exitance = Spectrum(bands, exitance);
      surface.object = object;
      surface.name = object + ", face \"" + std::to_string(cluster.polygons.size()) + "\"";
      cluster.polygons.push_back({SurfaceId(scene.surfaces.size()), face});
      scene.surfaces.push_back(surface);
      for (const Vec3& p : face) cluster.bounds.add(p);
      cluster.area_m2 += area_m2(face);
    }
    clusters.push_back(cluster);
  }
  /// One slab a room along x, cut half way through the walls between them.
  void add_cells(int rooms) {
    std::vector<Cell> all;
    std::vector<BspNode> nodes;
    for (int r = 0; r < rooms; ++r) {
      Cell cell;
      cell.id = CellId(r);
      cell.bounds.add(Vec3(4.2 * r, 0, 0));
      cell.bounds.add(Vec3(4.2 * r + 4, 5, 3));
      cell.volume_m3 = 60;
      all.push_back(cell);
      BspNode leaf;
      leaf.cell = cell.id;
      if (r + 1 == rooms) {
        nodes.push_back(leaf);
        continue;
      }
      BspNode cut;
      cut.plane = {Vec3(1, 0, 0), 4.2 * r + 4.1};
      cut.back = static_cast<std::int32_t>(nodes.size()) + 1;
      cut.front = cut.back + 1;
      nodes.push_back(cut);
      nodes.push_back(leaf);
    }
    cells = CellComplex(all, {}, nodes, 1e-5);
  }
};

}  // namespace enfilade::test
