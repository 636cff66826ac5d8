#include "bounds/factors/group_sight.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "bounds/factors/pair_geometry.hpp"
#include "bounds/factors/pair_sight.hpp"

namespace enfilade {
namespace {

/// Walls tried along one line of sight.
constexpr int most_walls = 4;

}  // namespace

GroupSight::GroupSight(std::span<const Polygon> polygons, double tolerance_m,
                       std::span<const char> panes)
    : polygons_(polygons), tolerance_m_(tolerance_m), rays_(polygons, panes) {
  // Planes that round alike are one; where two of the same plane round apart, walls of it are tried
  // separately, and less is proved.
  std::map<std::array<std::int64_t, 4>, std::uint32_t> numbers;
  const double step = std::max(10.0 * tolerance_m, 1e-300);
  Box box;
  for (const Polygon& polygon : polygons) box.add(bounds(polygon));
  for (const Polygon& polygon : polygons) {
    Plane plane = plane_of(polygon);
    const Vec3 a = glm::abs(plane.n);
    const double leading = a.x >= a.y && a.x >= a.z ? plane.n.x
                           : a.y >= a.z             ? plane.n.y
                                                    : plane.n.z;
    if (leading < 0.0) plane = plane.flipped();
    const auto key = [](double x) { return static_cast<std::int64_t>(std::llround(x)); };
    const std::array<std::int64_t, 4> rounded{
        key(plane.n.x * 1e5), key(plane.n.y * 1e5), key(plane.n.z * 1e5),
        key(plane.signed_distance(box.center()) / step / 10.0)};
    const auto [at, is_new] =
        numbers.try_emplace(rounded, static_cast<std::uint32_t>(polygons_of_.size()));
    if (is_new) polygons_of_.emplace_back();
    if (panes.empty() || panes[plane_of_.size()] == 0)
      polygons_of_[at->second].push_back(static_cast<std::uint32_t>(plane_of_.size()));
    plane_of_.push_back(at->second);
  }
}

bool GroupSight::hidden(const FlatShape& receiver, std::uint32_t receiver_polygon,
                        const std::vector<Vec3>& corners, std::uint32_t target_polygon) const {
  Vec3 middle(0.0);
  for (const Vec3& p : corners) middle += p;
  middle /= static_cast<double>(corners.size());
  const Vec3 direction = middle - receiver.center;
  const double length = glm::length(direction);
  if (length <= tolerance_m_) return false;
  Vec3 from = receiver.center;
  double left_m = length;
  std::uint32_t skip = receiver_polygon;
  for (int i = 0; i < most_walls && left_m > 0.0; ++i) {
    const RayHit hit = rays_.closest(from, direction, skip, left_m);
    if (!hit.any()) return false;
    const bool may_hide = hit.polygon != receiver_polygon && hit.polygon != target_polygon;
    if (may_hide && wall_hides(polygons_[hit.polygon], receiver.polygon, corners)) return true;
    const std::vector<std::uint32_t>& together = polygons_of_[plane_of_[hit.polygon]];
    if (may_hide && together.size() > 1) {
      const Plane plane = plane_of(polygons_[hit.polygon]);
      std::vector<const Polygon*> walls;
      for (const std::uint32_t k : together) {
        if (k != receiver_polygon && k != target_polygon &&
            lies_in(polygons_[k], plane, tolerance_m_))
          walls.push_back(&polygons_[k]);
      }
      if (walls_hide(plane, walls, receiver.polygon, corners, tolerance_m_)) return true;
    }
    from += direction * (hit.distance_m / length);
    left_m -= hit.distance_m;
    skip = hit.polygon;
  }
  return false;
}

double GroupSight::most_factor(const FlatShape& receiver, const Box& box) {
  if (highest_distance(box, receiver.plane) <= 0.0) return 0.0;
  const double radius = 0.5 * box.diagonal();
  const double distance = least_distance(receiver, FlatShape({box.center()}, receiver.plane));
  if (distance <= radius) return 1.0;
  return radius * radius / (distance * distance);
}

}  // namespace enfilade
