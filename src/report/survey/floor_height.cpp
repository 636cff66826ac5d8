#include "report/survey/floor_height.hpp"

#include <algorithm>
#include <cmath>

namespace enfilade {
namespace {

constexpr std::size_t points_of_room = 200;
constexpr double floor_share = 0.25;
constexpr double most_step_m = 0.03, step_share = 0.01;
/// Cosine of the slope up to which a surface is a floor.
constexpr double level_floor = 0.9;

/// The start of the run of sorted heights, within `step_m`, that is the floor.
double floor_of(const std::vector<double>& heights, double step_m) {
  std::size_t most = 0;
  double best = heights.front();
  for (std::size_t i = 0, end = 0; i < heights.size(); ++i) {
    while (end < heights.size() && heights[end] <= heights[i] + step_m) ++end;
    const std::size_t count = end - i;
    const double middle = heights[i + count / 2];
    if (static_cast<double>(count) >= floor_share * static_cast<double>(heights.size()))
      return middle;
    if (count > most) {
      most = count;
      best = middle;
    }
  }
  return best;
}

}  // namespace

FloorHeight floor_height(const Occluders& occluders, const RoomPlan& plan, double from_m) {
  std::vector<double> below, above;
  for (const Vec2& p : plan.spread(points_of_room)) {
    const Vec3 from(p, from_m);
    const RayHit down = occluders.rays().closest(from, Vec3(0, 0, -1));
    if (down.any() && std::abs(normal(occluders.polygon(down.polygon)).z) > level_floor)
      below.push_back(from_m - down.distance_m);
    const RayHit up = occluders.rays().closest(from, Vec3(0, 0, 1));
    if (up.any()) above.push_back(from_m + up.distance_m);
  }
  FloorHeight found;
  std::ranges::sort(below);
  std::ranges::sort(above);
  if (!above.empty()) found.ceiling_m = above[above.size() / 2];
  if (below.empty()) return found;
  const double room_m = (above.empty() ? from_m : *found.ceiling_m) - below.front();
  found.floor_m = floor_of(below, std::min(most_step_m, step_share * room_m));
  return found;
}

}  // namespace enfilade
