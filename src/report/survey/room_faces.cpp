#include "report/survey/room_faces.hpp"

#include <algorithm>
#include <cmath>

#include "report/pictures/one_value.hpp"

namespace enfilade {
namespace {

constexpr std::size_t ceiling_points = 400;
/// Samples along a room's edge, all of it, and over its height.
constexpr double along_edge = 200.0;
constexpr int over_height = 8;
/// A wall is looked for from this far inside the plan's edge, and as far beyond it. A share of the
/// room's shorter side.
constexpr double most_reach_m = 0.1, reach_share = 0.05;
/// Cosines of the slopes up to which a surface is a ceiling, and a wall.
constexpr double level_face = 0.5, upright_face = 0.3;

class Mean {
 public:
  explicit Mean(const SolvedScene& solved) : solved_(solved) {}

  /// `accepts`: by the surface's normal.
  template <class Accepts>
  void add(const Vec3& from, const Vec3& direction, double reach_m, const Accepts& accepts) {
    const RayHit hit =
        solved_.occluders.rays().closest(from, direction, RayScene::no_polygon, reach_m);
    if (!hit.any() || !hit.front) return;
    const PolygonRef ref = solved_.occluders.local(hit.polygon);
    const PatchForest& forest = solved_.states[ref.cluster.index()].patches();
    const PolygonFrame& frame = forest.frames()[ref.polygon];
    if (!accepts(frame.n)) return;
    std::vector<double> light(static_cast<std::size_t>(forest.bands()));
    forest.evaluate(false, ref.polygon, from + hit.distance_m * direction, light);
    sum_ += std::max(0.0, one_value(solved_.scene, light));
    ++count_;
  }

  std::optional<double> value() const {
    return count_ > 0 ? std::optional(sum_ / static_cast<double>(count_)) : std::nullopt;
  }

 private:
  const SolvedScene& solved_;
  double sum_ = 0.0;
  std::size_t count_ = 0;
};

std::optional<double> wall_light(const SolvedScene& solved, const SurveyRoom& room) {
  Mean mean(solved);
  double edge_m = 0.0;
  const auto for_each_edge = [&](const auto& visit) {
    for (const auto& ring : room.plan.rings()) {
      for (std::size_t i = 0; i < ring.size(); ++i) visit(ring[i], ring[(i + 1) % ring.size()]);
    }
  };
  for_each_edge([&](const Vec2& a, const Vec2& b) { edge_m += glm::length(b - a); });
  const double step_m = edge_m / along_edge;
  const double reach_m = std::min(most_reach_m, reach_share * room.plan.rectangle().width_m);
  double at_m = 0.5 * step_m;  // along the edge that follows
  for_each_edge([&](const Vec2& a, const Vec2& b) {
    const double length_m = glm::length(b - a);
    const Vec2 along = (b - a) / std::max(length_m, 1e-30), outward(-along.y, along.x);
    for (; at_m < length_m; at_m += step_m) {
      for (int k = 0; k < over_height; ++k) {
        const double z = room.floor_m + (k + 0.5) / over_height * room.height_m();
        mean.add(Vec3(a + at_m * along - reach_m * outward, z), Vec3(outward, 0.0), 2.0 * reach_m,
                 [](const Vec3& n) { return std::abs(n.z) < upright_face; });
      }
    }
    at_m -= length_m;
  });
  return mean.value();
}

}  // namespace

FaceLight face_light(const SolvedScene& solved, const SurveyRoom& room) {
  FaceLight light;
  light.walls = wall_light(solved, room);
  Mean ceiling(solved);
  for (const Vec2& p : room.plan.spread(ceiling_points)) {
    // From below the ceiling, so that neither tables nor hanging lamps are in the way.
    const double below_m = 0.1 * room.height_m();
    ceiling.add(Vec3(p, room.ceiling_m - below_m), Vec3(0, 0, 1), 1e30,
                [](const Vec3& n) { return n.z < -level_face; });
  }
  light.ceiling = ceiling.value();
  return light;
}

}  // namespace enfilade
