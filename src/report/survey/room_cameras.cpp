#include "report/survey/room_cameras.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "report/survey/one_value.hpp"
#include "report/survey/standing_place.hpp"

namespace enfilade {
namespace {

constexpr int directions = 32;
constexpr std::size_t places_tried = 64;
/// Of the eye's height: so far away from everything stands a person, and sees what lies ahead.
constexpr double elbow_share = 0.25, ahead_share = 1.0;
/// A room is lit where what is seen from its place has this share of the light of the brightest.
constexpr double lit_share = 0.02;
constexpr double picture_angle_deg = 62.0;

Vec3 direction(int i) {
  const double angle = 2.0 * std::numbers::pi * (i % directions) / directions;
  return {std::cos(angle), std::sin(angle), 0.0};
}

/// What is seen round about from a place: how far, within the room, and how bright.
struct Outlook {
  std::array<double, directions> wall_m{}, view_m{}, light{};
};

class Standing {
 public:
  Standing(const SolvedScene& solved, const SurveyRoom& room, double eye_height_m)
      : solved_(solved),
        room_(room),
        eye_height_m_(std::min(eye_height_m, 0.6 * room.height_m())) {}

  /// A place and where it looks; `light` is the mean light ahead.
  struct View {
    Camera camera;
    double worth = -1.0, light = 0.0;
  };
  View best() const {
    View best;
    std::vector<Vec2> places = room_.plan.spread(places_tried);
    places.push_back(room_.plan.middle());
    for (const Vec2& p : places) {
      const Vec3 eye(p, room_.floor_m + eye_height_m_);
      if (place_of(solved_.occluders, room_, eye) == PointPlace::open) consider(eye, best);
    }
    return best;
  }

 private:
  Outlook look_round(const Vec3& eye) const {
    Outlook found;
    for (std::size_t i = 0; i < directions; ++i) {
      const Vec3 d = direction(static_cast<int>(i));
      const RayHit hit = solved_.occluders.rays().closest(eye, d);
      found.wall_m[i] = hit.any() ? hit.distance_m : 1e30;
      found.view_m[i] = std::min(found.wall_m[i], leaves_plan_m(Vec2(eye), Vec2(d)));
      if (!hit.any() || !hit.front) continue;
      const PolygonRef ref = solved_.occluders.local(hit.polygon);
      const PatchForest& forest = solved_.states[ref.cluster.index()].patches();
      Spectrum light(static_cast<std::size_t>(forest.bands()));
      forest.evaluate(true, ref.polygon, eye + hit.distance_m * d, light);
      found.light[i] = std::max(0.0, one_value(solved_.scene, light));
    }
    return found;
  }

  /// Distance along the ray to where it first crosses the plan's edge.
  double leaves_plan_m(const Vec2& from, const Vec2& d) const {
    double nearest = 1e30;
    for (const auto& ring : room_.plan.rings()) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2 a = ring[i] - from, edge = ring[(i + 1) % ring.size()] - ring[i];
        const double across = d.x * edge.y - d.y * edge.x;
        if (std::abs(across) < 1e-12) continue;
        const double t = (a.x * edge.y - a.y * edge.x) / across;
        const double s = (a.x * d.y - a.y * d.x) / across;
        if (t > 0.0 && s >= 0.0 && s <= 1.0) nearest = std::min(nearest, t);
      }
    }
    return nearest;
  }

  /// The longest view, with free room to both sides of it, wins; behind the eye little room is
  /// left.
  void consider(const Vec3& eye, View& best) const {
    const Outlook seen = look_round(eye);
    const double elbow_m = elbow_share * eye_height_m_;
    if (*std::ranges::min_element(seen.wall_m) < elbow_m) return;
    for (int i = 0; i < directions; ++i) {
      double length_m = 0.0, light = 0.0, nearest_m = 1e30;
      constexpr int half = 3;
      for (int k = -half; k <= half; ++k) {
        const std::size_t at = static_cast<std::size_t>((i + k + directions) % directions);
        length_m += seen.view_m[at] / (2 * half + 1);
        light += seen.light[at] / (2 * half + 1);
        nearest_m = std::min(nearest_m, seen.wall_m[at]);
      }
      if (nearest_m < ahead_share * eye_height_m_) length_m *= 0.25;
      if (length_m <= best.worth) continue;
      best.worth = length_m;
      best.light = light;
      best.camera.eye = eye;
      // A little downward: the floor shows more of the light than the ceiling.
      best.camera.look_at = eye + direction(i) - Vec3(0, 0, 0.10);
    }
  }

  const SolvedScene& solved_;
  const SurveyRoom& room_;
  double eye_height_m_;
};

}  // namespace

std::optional<Camera> standing_camera(const SolvedScene& solved, const SurveyRoom& room,
                                      double eye_height_m) {
  Standing::View view = Standing(solved, room, eye_height_m).best();
  if (view.worth < 0.0) return std::nullopt;
  view.camera.name = room.name;
  view.camera.vertical_angle_deg = picture_angle_deg;
  return view.camera;
}

std::vector<Camera> room_cameras(const SolvedScene& solved, std::span<const SurveyRoom> rooms,
                                 const AutoCameraConfig& config) {
  std::vector<std::size_t> order(rooms.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, std::greater{}, [&](std::size_t i) { return rooms[i].area_m2; });
  std::vector<Standing::View> views;
  double brightest = 0.0;
  // Twice as many as are wanted, of which the dark ones are left out.
  for (const std::size_t i : order) {
    if (static_cast<int>(views.size()) >= 2 * config.inside) break;
    Standing::View view = Standing(solved, rooms[i], config.eye_height_m).best();
    if (view.worth < 0.0) continue;
    brightest = std::max(brightest, view.light);
    views.push_back(view);
  }
  std::erase_if(views, [&](const auto& view) { return !(view.light > lit_share * brightest); });
  if (views.empty()) return automatic_cameras(solved, config);
  std::vector<Camera> cameras;
  for (Standing::View& view : views) {
    if (static_cast<int>(cameras.size()) >= config.inside) break;
    view.camera.name = "room-" + std::to_string(cameras.size() + 1);
    view.camera.vertical_angle_deg = picture_angle_deg;
    cameras.push_back(view.camera);
  }
  AutoCameraConfig above = config;
  above.inside = 0;
  for (Camera& camera : automatic_cameras(solved, above)) cameras.push_back(std::move(camera));
  return cameras;
}

}  // namespace enfilade
