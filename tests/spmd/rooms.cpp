#include "rooms.hpp"

#include <filesystem>
#include <string>

#include "scene_file/scene_io.hpp"
#include "schemes/protocol/prepare_on_root.hpp"

namespace enfilade::spmd_tests {
namespace {

/// Reflectance and exitance of a surface.
struct Finish {
  double reflectance = 0.5, exitance = 0.0;
};

void add_quad(Scene& scene, const std::string& object, Finish finish, Vec3 a, Vec3 b, Vec3 c,
              Vec3 d) {
  Surface s;
  s.vertices = {a, b, c, d};
  s.reflectance = {finish.reflectance};
  s.exitance = {finish.exitance};
  s.object = object;
  scene.surfaces.push_back(s);
}

/// The six sides of a box, facing in or out.
void add_box(Scene& scene, const std::string& object, Finish finish, Vec3 lo, Vec3 hi,
             bool inwards) {
  const auto side = [&](Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
    inwards ? add_quad(scene, object, finish, a, b, c, d)
            : add_quad(scene, object, finish, d, c, b, a);
  };
  const auto at = [&](int x, int y, int z) {
    return Vec3(x ? hi.x : lo.x, y ? hi.y : lo.y, z ? hi.z : lo.z);
  };
  side(at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0));
  side(at(0, 0, 1), at(0, 1, 1), at(1, 1, 1), at(1, 0, 1));
  side(at(0, 0, 0), at(0, 0, 1), at(1, 0, 1), at(1, 0, 0));
  side(at(0, 1, 0), at(1, 1, 0), at(1, 1, 1), at(0, 1, 1));
  side(at(0, 0, 0), at(0, 1, 0), at(0, 1, 1), at(0, 0, 1));
  side(at(1, 0, 0), at(1, 0, 1), at(1, 1, 1), at(1, 1, 0));
}

/// A wall with a door, seen from both rooms: two jambs and a lintel, 0.2 m thick.
void add_rooms(Scene& scene, Finish finish) {
  add_box(scene, "house", finish, {0, 0, 0}, {8.2, 4, 2.5}, true);
  add_box(scene, "jamb 1", finish, {4, 0, 0}, {4.2, 1.5, 2.5}, false);
  add_box(scene, "jamb 2", finish, {4, 2.5, 0}, {4.2, 4, 2.5}, false);
  add_box(scene, "lintel", finish, {4, 1.5, 2.0}, {4.2, 2.5, 2.5}, false);
  add_box(scene, "crate", finish, {1, 1, 0.3}, {1.7, 2.2, 1.1}, false);
}

}  // namespace

Scene furnace() {
  Scene scene;
  add_rooms(scene, {0.5, 0.5 * level});
  return scene;
}

Scene lit_rooms() {
  Scene scene;
  add_rooms(scene, {});
  double reflectance = 0.2;
  for (Surface& surface : scene.surfaces) {
    surface.reflectance = {reflectance};
    reflectance = reflectance > 0.75 ? 0.2 : reflectance + 0.07;
  }
  add_quad(scene, "lamp", {0.1, 100.0}, {2, 1.5, 2.45}, {2, 2.5, 2.45}, {3, 2.5, 2.45},
           {3, 1.5, 2.45});
  // A leaning luminaire with an opening in the other room.
  LightSource luminaire{{6.0, 1.8, 2.3}, {3.0}};
  luminaire.distribution = std::make_shared<const IntensityDistribution>(IntensityTable{
      PhotometryType::c, {0, 90, 180}, {0, 30, 60, 90}, {9, 8, 5, 0, 9, 6, 3, 0, 9, 4, 1, 0}});
  luminaire.frame = LightFrame::of({0.2, 0.1, -1.0}, {0.0, 1.0, 0.0}).value();
  luminaire.shape = {OpeningShape::rectangle, {0.6, 0.3, 0.0}};
  scene.lights.push_back(luminaire);
  return scene;
}

Scene lit_hall() {
  Scene scene;
  add_box(scene, "hall", {0.6}, {0, 0, 0}, {24, 24, 4}, true);
  for (int i = 0; i < 144; ++i) {
    const Vec3 lo(2.0 * (i % 12) + 0.5, 2.0 * (i / 12) + 0.6, 0.1);
    add_box(scene, "crate " + std::to_string(i), {0.3 + 0.05 * (i % 7)}, lo,
            lo + Vec3(0.9, 0.6, 0.5 + 0.1 * (i % 5)), false);
  }
  for (int i = 0; i < 4; ++i) {
    const Vec3 at(5.0 + 12.0 * (i % 2), 5.0 + 12.0 * (i / 2), 3.9);
    add_quad(scene, "lamp", {0.1, 100.0}, at, at + Vec3(0, 1, 0), at + Vec3(1, 1, 0),
             at + Vec3(1, 0, 0));
  }
  return scene;
}

Prepared prepared_in(Context& context, const std::string& run, const Scene& scene) {
  const std::string scene_file = context.directory + "/scene.json";
  context.communicator.barrier();  // a solve before has left its local directories on every rank
  context.communicator.on_root([&] {
    if (!context.resume) std::filesystem::remove_all(run);
    write_scene(scene, scene_file);
  });
  Warnings warnings;
  RunLock lock;
  return prepare_on_root(
      context.communicator,
      [&scene_file](Warnings& found) { return read_scene(scene_file, found); }, run, {}, warnings,
      {}, false, lock);
}

std::vector<double> all_radiosities(const std::vector<ClusterState>& clusters) {
  std::vector<double> all;
  for (const ClusterState& state : clusters) {
    for (std::size_t i = 0; i < state.patches().size(); ++i) {
      const std::span<const double> light = state.patches().radiosity(i);
      all.insert(all.end(), light.begin(), light.end());
    }
  }
  return all;
}

std::vector<double> mean_radiosities(const std::vector<ClusterState>& clusters) {
  std::vector<double> means;
  for (const ClusterState& state : clusters) {
    double power = 0.0, area = 0.0;
    for (std::size_t i = 0; i < state.patches().polygons(); ++i) {
      power += state.patches().node(i).shape.area_m2 * state.patches().radiosity(i)[0];
      area += state.patches().node(i).shape.area_m2;
    }
    means.push_back(power / area);
  }
  return means;
}

}  // namespace enfilade::spmd_tests
