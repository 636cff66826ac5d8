#include "report/survey/room_cameras.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "report/pictures/one_value.hpp"
#include "report/survey/standing_place.hpp"

namespace enfilade {
namespace {

constexpr int directions = 32;
constexpr std::size_t places_tried = 32;
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

  std::optional<RoomView> best() const {
    Best best;
    std::vector<Vec2> places = room_.plan.spread(places_tried);
    places.push_back(room_.plan.middle());
    for (const Vec2& p : places) {
      const Vec3 eye(p, room_.floor_m + eye_height_m_);
      if (place_of(solved_.occluders, room_, eye) == PointPlace::open) consider(eye, best);
    }
    if (best.length_m < 0.0) return std::nullopt;
    Camera& camera = best.view.camera;
    camera.title = room_.long_name.empty() ? room_.name : room_.name + " " + room_.long_name;
    camera.vertical_angle_deg = picture_angle_deg;
    return best.view;
  }

 private:
  struct Best {
    RoomView view;
    double length_m = -1.0;
  };

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
  void consider(const Vec3& eye, Best& best) const {
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
      if (length_m <= best.length_m) continue;
      best.length_m = length_m;
      best.view.light = light;
      best.view.camera.eye = eye;
      // A little downward: the floor shows more of the light than the ceiling.
      best.view.camera.look_at = eye + direction(i) - Vec3(0, 0, 0.10);
    }
  }

  const SolvedScene& solved_;
  const SurveyRoom& room_;
  double eye_height_m_;
};

}  // namespace

std::optional<RoomView> standing_view(const SolvedScene& solved, const SurveyRoom& room,
                                      double eye_height_m) {
  return Standing(solved, room, eye_height_m).best();
}

std::vector<std::optional<RoomView>> standing_views(const SolvedScene& solved,
                                                    std::span<const SurveyRoom> rooms,
                                                    double eye_height_m) {
  std::vector<std::optional<RoomView>> views;
  for (const SurveyRoom& room : rooms) views.push_back(standing_view(solved, room, eye_height_m));
  return views;
}

std::vector<std::size_t> rooms_to_show(std::span<const SurveyRoom> rooms,
                                       std::span<const std::optional<RoomView>> views) {
  double brightest = 0.0;
  for (const auto& view : views) brightest = std::max(brightest, view ? view->light : 0.0);
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < rooms.size(); ++i) {
    if (views[i] && rooms[i].has_ceiling && views[i]->light > lit_share * brightest)
      order.push_back(i);
  }
  std::ranges::stable_sort(order, std::greater{}, [&](std::size_t i) { return rooms[i].area_m2; });
  return order;
}

std::vector<Camera> room_cameras(const SolvedScene& solved, std::span<const SurveyRoom> rooms,
                                 std::span<const std::optional<RoomView>> views,
                                 const AutoCameraConfig& config) {
  const std::vector<std::size_t> shown = rooms_to_show(rooms, views);
  if (shown.empty()) return automatic_cameras(solved, config);
  std::vector<Camera> cameras;
  for (const std::size_t i : shown) {
    if (static_cast<int>(cameras.size()) >= config.inside) break;
    cameras.push_back(views[i]->camera);
    cameras.back().name = "room-" + std::to_string(cameras.size());
  }
  AutoCameraConfig above = config;
  above.inside = 0;
  for (Camera& camera : automatic_cameras(solved, above)) cameras.push_back(std::move(camera));
  return cameras;
}

}  // namespace enfilade
