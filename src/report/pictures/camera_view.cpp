#include "report/pictures/camera_view.hpp"

#include <algorithm>
#include <cmath>

#include "base/random.hpp"
#include "geometry/sampling.hpp"

namespace enfilade {

CameraView::CameraView(const SolvedScene& solved, const Camera& camera, double aspect)
    : solved_(solved), camera_(camera) {
  forward_ = glm::normalize(camera.look_at - camera.eye);
  Vec3 across = glm::cross(forward_, camera.up);
  // Looking along `up`: any horizontal will do.
  if (glm::length(across) < 1e-9) across = glm::cross(forward_, Vec3(0.0, 1.0, 0.0));
  if (glm::length(across) < 1e-9) across = Vec3(1.0, 0.0, 0.0);
  const double half = camera.parallel_height_m > 0.0
                          ? 0.5 * camera.parallel_height_m
                          : std::tan(0.5 * glm::radians(camera.vertical_angle_deg));
  right_ = glm::normalize(across) * (half * aspect);
  up_ = glm::normalize(glm::cross(across, forward_)) * half;
  std::size_t polygons = 0;
  for (const ClusterState& state : solved.states) polygons += state.patches().polygons();
  outer_ = std::make_unique<std::atomic<Outer>[]>(polygons);
}

CameraView::Ray CameraView::ray(double x, double y) const {
  const Vec3 shift = x * right_ + y * up_;
  if (camera_.parallel_height_m > 0.0) return {camera_.eye + shift, forward_};
  return {camera_.eye, glm::normalize(forward_ + shift)};
}

/// The first visible polygon; of two that lie back to back in one place, the one that faces the
/// eye.
CameraView::Met CameraView::first_seen(const Ray& ray, std::uint32_t skip) const {
  const RayScene& rays = solved_.occluders.rays();
  Met met;
  met.hit = rays.closest(ray.from, ray.direction, skip);
  met.p = ray.from + met.hit.distance_m * ray.direction;
  if (!met.hit.any() || met.hit.front) return met;
  const double step_m = 4.0 * rays.epsilon_m();
  const RayHit twin =
      rays.closest(met.p - step_m * ray.direction, ray.direction, met.hit.polygon, 2.0 * step_m);
  if (twin.any() && twin.front) met.hit = twin;
  return met;
}

CameraView::Seen CameraView::at(double x, double y) const {
  Ray looking = ray(x, y);
  if (camera_.cut_above_m && !go_to_cut(looking)) return {};
  std::uint32_t skip = RayScene::no_polygon;
  for (int culled = 0; culled < 256; ++culled) {
    const Met met = first_seen(looking, skip);
    if (!met.hit.any()) return leaving(looking, skip);
    if (camera_.cut_above_m && culled == 0 && !met.hit.front && inside_solid(looking.from))
      return {Seen::What::section, RayScene::no_polygon, {}};
    if (!camera_.cut_above_m || (met.hit.front && !outer(met.hit.polygon))) {
      Seen seen{met.hit.front ? Seen::What::front : Seen::What::back, met.hit.polygon, met.p};
      if (solved_.occluders.panes().any()) find_panes(looking, met.hit.distance_m, skip, seen);
      return seen;
    }
    looking.from = met.p;
    skip = met.hit.polygon;
  }
  return {};
}

CameraView::Seen CameraView::leaving(const Ray& ray, std::uint32_t skip) const {
  Seen seen;
  const auto is_far = [](const LightSource& light) { return light.is_far(); };
  if (camera_.cut_above_m || camera_.parallel_height_m > 0.0 ||
      std::ranges::none_of(solved_.scene.lights, is_far))
    return seen;
  seen.outward = ray.direction;
  if (solved_.occluders.panes().any()) find_panes(ray, far_away_m, skip, seen);
  return seen;
}

void CameraView::find_panes(const Ray& ray, double distance_m, std::uint32_t skip,
                            Seen& seen) const {
  for (const PaneMet& pane :
       solved_.occluders.panes_along(ray.from, ray.direction, distance_m, skip)) {
    seen.panes.push_back({pane, ray.from + pane.distance_m * glm::normalize(ray.direction)});
  }
}

/// Moves a ray that starts above the cut down to it; false where it never comes there.
bool CameraView::go_to_cut(Ray& ray) const {
  const double above_m = ray.from.z - *camera_.cut_above_m;
  if (above_m <= 0.0) return true;
  if (ray.direction.z >= 0.0) return false;
  ray.from += above_m / -ray.direction.z * ray.direction;
  return true;
}

/// Within a closed solid everything around shows its back.
bool CameraView::inside_solid(const Vec3& p) const {
  const Vec3 around[] = {
      {0.9, 0.4, 0.1}, {-0.9, -0.3, 0.2}, {0.3, -0.9, 0.15}, {-0.4, 0.9, -0.2}, {0.1, 0.2, 1.0}};
  return std::all_of(std::begin(around), std::end(around), [&](const Vec3& d) {
    const RayHit hit = solved_.occluders.rays().closest(p, d);
    return hit.any() && !hit.front;
  });
}

/// A facade: upright or downward, with open sky or nothing before most of it. It hides the rooms
/// in a cut-away.
bool CameraView::outer(std::uint32_t polygon) const {
  Outer known = outer_[polygon].load(std::memory_order_relaxed);
  if (known == Outer::unknown) {
    known = looks_outward(polygon) ? Outer::yes : Outer::no;
    outer_[polygon].store(known, std::memory_order_relaxed);
  }
  return known == Outer::yes;
}
bool CameraView::looks_outward(std::uint32_t polygon) const {
  constexpr int looks = 24;
  const PolygonRef ref = solved_.occluders.local(polygon);
  const PatchForest& forest = solved_.states[ref.cluster.index()].patches();
  const PolygonFrame& frame = forest.frames()[ref.polygon];
  if (frame.n.z > 0.5) return false;
  const Vec3 p = frame.at(forest.node(ref.polygon).shape.centroid);
  Random random(polygon + 1);
  int free = 0;
  for (int i = 0; i < looks; ++i) {
    const double z = 1.0 - 2.0 * random.uniform(), about = random.uniform();
    // Cosine-weighted: a point of the unit sphere that stands on the plane.
    const Vec3 d = 1.001 * frame.n + sphere_direction(z, about);
    free += !solved_.occluders.rays().closest(p, d, polygon).any();
  }
  return free > looks / 2;
}

}  // namespace enfilade
