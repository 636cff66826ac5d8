#include <algorithm>
#include <cmath>
#include <numbers>

#include "report/pictures/camera.hpp"
#include "report/plans/storeys.hpp"
#include "scene/equal_bands.hpp"

namespace enfilade {

namespace {

constexpr int directions = 32;
constexpr std::size_t most_places = 600;

Vec3 direction(int i) {
  const double angle = 2.0 * std::numbers::pi * i / directions;
  return {std::cos(angle), std::sin(angle), 0.0};
}

double mean(std::span<const double> values) {
  double sum = 0.0;
  for (double v : values) sum += v;
  return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

/// A place for a camera, and the light and distances along the horizon from there.
struct Place {
  Vec3 eye;
  double distance_m[directions] = {};
  double light[directions] = {};  ///< 0 where the ray meets nothing or a back
  bool open[directions] = {};     ///< nothing stands there: a window, or the outside
  double room_m2 = 0.0, mean_light = 0.0, enclosed = 0.0;
};

class PlaceFinder {
 public:
  PlaceFinder(const SolvedScene& solved, double eye_height_m)
      : solved_(solved), eye_height_m_(eye_height_m) {}

  /// Places over lit floors, evenly taken from all of them.
  std::vector<Place> places() const {
    std::vector<Vec3> points;
    for (const ClusterState& state : solved_.states) add_floor_points(state.patches(), points);
    std::vector<Place> found;
    const std::size_t take = std::min(points.size(), most_places);
    for (std::size_t i = 0; i < take; ++i) {
      Place place;
      if (look_round(points[i * points.size() / take], place)) found.push_back(place);
    }
    return found;
  }

  double light_at(const RayHit& hit, const Vec3& p) const {
    const PolygonRef ref = solved_.occluders.local(hit.polygon);
    const PatchForest& forest = solved_.states[ref.cluster.index()].patches();
    std::vector<double> b(static_cast<std::size_t>(forest.bands()));
    forest.evaluate(true, ref.polygon, p, b);
    return std::max(0.0, mean(in_bands_of_file(solved_.scene, b)));
  }

 private:
  void add_floor_points(const PatchForest& forest, std::vector<Vec3>& points) const {
    for (std::size_t i = 0; i < forest.size(); ++i) {
      const PatchNode& node = forest.node(i);
      const PolygonFrame& frame = forest.frames()[node.id.root];
      const bool large = node.shape.area_m2 > 0.02 * eye_height_m_ * eye_height_m_;
      if (!node.leaf() || frame.n.z < 0.95 || !large) continue;
      if (forest.irradiance(i)[0] > 0.0) points.push_back(frame.at(node.shape.centroid));
    }
  }

  /// False where one cannot stand: no headroom, or inside of something.
  bool look_round(const Vec3& floor, Place& place) const {
    const RayScene& rays = solved_.occluders.rays();
    const RayHit above = rays.closest(floor, Vec3(0, 0, 1));
    if (!above.any() || !above.front || above.distance_m < 1.15 * eye_height_m_) return false;
    place.eye = floor + Vec3(0, 0, eye_height_m_);
    int behind = 0;
    std::vector<double> walls_m;
    for (int i = 0; i < directions; ++i) {
      const RayHit hit = rays.closest(place.eye, direction(i));
      behind += hit.any() && !hit.front;
      place.open[i] = !hit.any();
      place.distance_m[i] = hit.any() ? hit.distance_m : 0.0;
      if (hit.any()) walls_m.push_back(hit.distance_m);
      if (hit.any() && hit.front) {
        place.light[i] = light_at(hit, place.eye + hit.distance_m * direction(i));
      }
    }
    // A window is taken for a wall at the usual distance: what lies beyond is not the room.
    for (double& d : place.distance_m) d = d > 0.0 ? d : mean(walls_m);
    for (int i = 0; i < directions; ++i) {
      const double next_m = place.distance_m[(i + 1) % directions];
      place.room_m2 +=
          0.5 * place.distance_m[i] * next_m * std::sin(2.0 * std::numbers::pi / directions);
    }
    place.mean_light = mean(place.light);
    place.enclosed = static_cast<double>(walls_m.size()) / directions;
    return behind <= directions / 8 && place.mean_light > 0.0;
  }

  const SolvedScene& solved_;
  double eye_height_m_;
};

/// Light ahead, over a third of the horizon, times the share of it where lit surfaces are: a
/// picture of windows or of black backs shows little.
double light_ahead(const Place& place, int i) {
  double sum = 0.0;
  int lit = 0;
  for (int k = -directions / 6; k <= directions / 6; ++k) {
    const double light = place.light[(i + k + directions) % directions];
    sum += light;
    lit += light > 0.0;
  }
  constexpr double looks = 2 * (directions / 6) + 1;
  return sum / looks * std::pow(lit / looks, 2);
}

/// On a floor, under a ceiling, with room to all sides and more of it ahead: no reveal or cupboard
/// fills the picture.
bool stands_free(const SolvedScene& solved, const Vec3& eye, int ahead, double eye_height_m) {
  const double least_m = 0.45 * eye_height_m;
  const RayScene& rays = solved.occluders.rays();
  const RayHit above = rays.closest(eye, Vec3(0, 0, 1)), below = rays.closest(eye, Vec3(0, 0, -1));
  if (!above.any() || !above.front || !below.any() || !below.front) return false;
  if (std::abs(below.distance_m - eye_height_m) > 0.05 * eye_height_m) return false;
  for (int i = 0; i < directions; ++i) {
    const int turn =
        std::min((i - ahead + directions) % directions, (ahead - i + directions) % directions);
    const double wanted_m = turn <= directions / 8 ? 3.0 * least_m : least_m;
    const RayHit hit = rays.closest(eye, direction(i), RayScene::no_polygon, wanted_m);
    if (hit.any()) return false;
  }
  return true;
}

/// Backed towards the wall behind, looking along the longest view, of its two ends the brighter.
Camera looking_far(const SolvedScene& solved, const Place& place, double eye_height_m,
                   const std::string& name) {
  const auto length = [&](int i) {
    return place.distance_m[i] + place.distance_m[(i + directions / 2) % directions];
  };
  int best = 0;
  const auto worth = [&](int i) {
    return length(i) * (0.1 * place.mean_light + light_ahead(place, i));
  };
  for (int i = 1; i < directions; ++i) {
    if (worth(i) > worth(best)) best = i;
  }
  const double back_m = place.distance_m[(best + directions / 2) % directions];
  Camera camera;
  camera.name = name;
  camera.eye = place.eye;
  const bool wall_behind = !place.open[(best + directions / 2) % directions];
  for (double share : {0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3, 0.2, 0.1}) {
    const Vec3 eye = place.eye - direction(best) * (share * back_m);
    if (!wall_behind || !stands_free(solved, eye, best, eye_height_m)) continue;
    camera.eye = eye;
    break;
  }
  // A little downward: the floor shows more of the light than the ceiling.
  camera.look_at = camera.eye + direction(best) - Vec3(0, 0, 0.10);
  camera.vertical_angle_deg = 62.0;
  return camera;
}

/// From the south-west and well above, all of the storey below its ceilings.
Camera cut_away(const Box& box, const Storey& storey, const std::string& name, double aspect) {
  const double cut_m = storey.floor_m + 0.75 * storey.headroom_m;
  Camera camera;
  camera.name = name;
  camera.cut_above_m = cut_m;
  const Vec3 centre(box.center().x, box.center().y, 0.5 * (storey.floor_m + cut_m));
  // Along the shorter side, so that the building lies across the picture.
  const bool wide = box.extent().x >= box.extent().y;
  const Vec3 from = glm::normalize(wide ? Vec3(-0.22, -0.55, 1.0) : Vec3(-0.55, 0.22, 1.0));
  camera.eye = centre + from * (2.0 * box.diagonal() + 1.0);
  camera.look_at = centre;
  const Vec3 right = glm::normalize(glm::cross(-from, camera.up)), up = glm::cross(right, -from);
  double across = 0.0, high = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p((corner & 1) ? box.hi.x : box.lo.x, (corner & 2) ? box.hi.y : box.lo.y,
                 (corner & 4) ? cut_m : storey.floor_m);
    across = std::max(across, std::abs(glm::dot(p - centre, right)));
    high = std::max(high, std::abs(glm::dot(p - centre, up)));
  }
  camera.parallel_height_m = 2.0 * 1.06 * std::max(high, across / aspect);
  return camera;
}

void add_inside_views(const SolvedScene& solved, const AutoCameraConfig& config,
                      double eye_height_m, std::vector<Camera>& cameras) {
  std::vector<Place> places = PlaceFinder(solved, eye_height_m).places();
  double usual_light = 0.0;
  for (const Place& p : places) usual_light += p.mean_light / static_cast<double>(places.size());
  const auto worth = [&](const Place& p) {
    return std::sqrt(p.room_m2) * std::min(1.0, p.mean_light / usual_light) * p.enclosed *
           p.enclosed;
  };
  std::stable_sort(places.begin(), places.end(),
                   [&](const Place& a, const Place& b) { return worth(a) > worth(b); });
  std::vector<Vec3> taken;
  for (const Place& place : places) {
    if (static_cast<int>(taken.size()) >= config.inside) return;
    // A room that is visible from an earlier camera is in that picture.
    const bool seen = std::any_of(taken.begin(), taken.end(), [&](const Vec3& eye) {
      return !solved.occluders.rays().occluded(eye, place.eye);
    });
    if (seen) continue;
    taken.push_back(place.eye);
    cameras.push_back(
        looking_far(solved, place, eye_height_m, "room-" + std::to_string(taken.size())));
  }
}

}  // namespace

std::vector<Camera> automatic_cameras(const SolvedScene& solved, const AutoCameraConfig& config) {
  const std::vector<Storey> levels = storeys(solved.building());
  double headroom_m = levels.front().headroom_m;
  for (const Storey& s : levels) headroom_m = std::max(headroom_m, s.headroom_m);
  std::vector<Camera> cameras;
  add_inside_views(solved, config, std::min(config.eye_height_m, 0.6 * headroom_m), cameras);
  for (std::size_t i = 0; config.cut_away && i < levels.size(); ++i) {
    if (static_cast<int>(i) >= config.most_storeys) break;
    cameras.push_back(cut_away(room_bounds(solved.building()), levels[i],
                               "storey-" + std::to_string(i + 1), config.aspect));
  }
  return cameras;
}

}  // namespace enfilade
