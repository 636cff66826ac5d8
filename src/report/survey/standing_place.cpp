#include "report/survey/standing_place.hpp"

#include <algorithm>
#include <cmath>

#include "final_gather/point_place.hpp"
#include "geometry/sampling.hpp"

namespace enfilade {
namespace {

constexpr int rays_round = 64;
/// Inside of a solid nearly all rays end on backs. In a room some of them may as well: a ceiling
/// that faces the wrong way is half of what a point below it sees.
constexpr double backs_share = 0.8;
constexpr double golden_turn = 0.6180339887498949;
/// A floor this much below the room's own is another room's: a share of the room's height.
constexpr double floor_step_share = 0.2;
/// Under a lid: so many of the rays upward end within this share of the room's shorter side and of
/// its height, as in a cupboard that shows its front inside as well, or under a table top.
constexpr double lid_share = 0.75, pocket_share = 0.25;

}  // namespace

PointPlace place_of(const Occluders& occluders, const SurveyRoom& room, const Vec3& at) {
  const Vec3 p = lifted(occluders, at, Vec3(0, 0, 1));  // a point on a table top lies above it
  const RayScene& rays = occluders.rays();
  const double pocket_m = pocket_share * std::min(room.plan.rectangle().width_m, room.height_m());
  int backs = 0, ends = 0, upward = 0, near_above = 0;
  for (int i = 0; i < rays_round; ++i) {
    const Vec3 d =
        sphere_direction(2.0 * (i + 0.5) / rays_round - 1.0, std::fmod(i * golden_turn, 1.0));
    const RayHit hit = rays.closest(p, d);
    ends += hit.any();
    backs += hit.any() && !hit.front;
    upward += d.z > 0.0;
    near_above += d.z > 0.0 && hit.any() && hit.distance_m < pocket_m;
  }
  if (backs > backs_share * ends || near_above > lid_share * upward)
    return PointPlace::in_furniture;
  if (!room.has_floor) return PointPlace::open;
  const RayHit below = rays.closest(p, Vec3(0, 0, -1));
  const double level_m = p.z - below.distance_m;
  const bool floor = below.any() && level_m >= room.floor_m - floor_step_share * room.height_m();
  return floor ? PointPlace::open : PointPlace::without_floor;
}

}  // namespace enfilade
