#include "bounds/factors/pair_sight.hpp"

#include <algorithm>

#include "geometry/clip.hpp"
#include "geometry/half_spaces.hpp"

namespace enfilade {
namespace {

/// Appends the parts of `whole` outside of the half spaces to `outside`, and the part inside, if
/// there is one, to `inside`.
void cut_by(const Polygon& whole, const HalfSpaces& spaces, double tolerance_m,
            std::vector<Polygon>& inside, std::vector<Polygon>& outside) {
  Polygon rest = whole;
  std::vector<Polygon> cut_off;
  for (const Plane& plane : spaces) {
    auto [front, behind] = split(rest, plane, tolerance_m);
    if (front.empty()) {  // nothing lies inside: the whole stays in one piece
      outside.push_back(whole);
      return;
    }
    if (!behind.empty()) cut_off.push_back(std::move(behind));
    rest = std::move(front);
  }
  outside.insert(outside.end(), cut_off.begin(), cut_off.end());
  inside.push_back(std::move(rest));
}

/// The occluder's unit normal away from the viewer; zero where the viewer has corners on both
/// sides.
Vec3 away_from(const FlatShape& viewer, const Plane& plane, double tolerance_m) {
  const DistanceRange range = distances(viewer.polygon, plane);
  if (range.lowest < -tolerance_m && range.highest > tolerance_m) return Vec3(0.0);
  return range.highest > -range.lowest ? -plane.n : plane.n;
}

/// The half spaces that hold the shadows which every corner of the viewer casts; none where a
/// corner lies in the occluder's plane.
HalfSpaces umbra(const FlatShape& viewer, const Polygon& occluder, const Vec3& away,
                 double tolerance_m) {
  HalfSpaces spaces{{away, glm::dot(away, occluder[0])}};
  const Vec3 middle = centroid(occluder);
  for (const Vec3& v : viewer.polygon) {
    if (-spaces[0].signed_distance(v) <= tolerance_m) return {};
    for (std::size_t i = 0; i < occluder.size(); ++i) {
      Vec3 n = glm::cross(occluder[i] - v, occluder[(i + 1) % occluder.size()] - v);
      const double length = glm::length(n);
      if (length <= 0.0) continue;
      n /= length;
      if (glm::dot(n, middle - v) < 0.0) n = -n;
      spaces.push_back({n, glm::dot(n, v)});
    }
  }
  return spaces;
}

/// One occluder's shadow, taken off what is seen and what is unsure.
void cast_shadow(const FlatShape& viewer, const Plane& target_plane, const Polygon& whole_occluder,
                 bool is_pane, double tolerance_m, SplitSight& sight) {
  Polygon occluder = whole_occluder;
  clip_front(occluder, viewer.plane, 0.0);
  if (!occluder.empty()) clip_front(occluder, target_plane, 0.0);
  if (occluder.size() < 3) return;
  const Plane plane = plane_of(whole_occluder);
  const Vec3 away = away_from(viewer, plane, tolerance_m);
  if (glm::dot(away, away) < 0.5) {
    sight.unsure.insert(sight.unsure.end(), sight.seen.begin(), sight.seen.end());
    sight.seen.clear();
    return;
  }
  HalfSpaces spaces{{away, glm::dot(away, occluder[0]) - tolerance_m}};
  add_penumbra(viewer.polygon, occluder, away, tolerance_m, spaces);
  std::vector<Polygon> seen;
  for (const Polygon& part : sight.seen) cut_by(part, spaces, 0.0, sight.unsure, seen);
  sight.seen = std::move(seen);
  if (is_pane) return;
  const HalfSpaces dark = umbra(viewer, occluder, away, tolerance_m);
  if (dark.empty()) return;
  std::vector<Polygon> hidden, unsure;
  for (const Polygon& part : sight.unsure) cut_by(part, dark, tolerance_m, hidden, unsure);
  sight.unsure = std::move(unsure);
}

/// The crossings of all corner-to-corner segments with a plane; false where one does not cross it.
bool crossings(const Plane& plane, const std::vector<Vec3>& a, const std::vector<Vec3>& b,
               std::vector<Vec3>& found) {
  for (const Vec3& p : a) {
    const double side_p = plane.signed_distance(p);
    for (const Vec3& q : b) {
      const double side_q = plane.signed_distance(q);
      if (side_p * side_q >= 0.0) return false;
      found.push_back(zero_crossing(p, side_p, q, side_q));
    }
  }
  return true;
}

}  // namespace

SplitSight split_sight(const FlatShape& viewer, const Polygon& target, const Plane& target_plane,
                       const std::vector<const Polygon*>& occluders, double tolerance_m,
                       std::size_t panes, std::size_t most_parts) {
  SplitSight sight;
  sight.seen.push_back(target);
  for (std::size_t i = 0; i < occluders.size(); ++i) {
    const bool is_pane = i + panes >= occluders.size();
    cast_shadow(viewer, target_plane, *occluders[i], is_pane, tolerance_m, sight);
    if (sight.seen.size() + sight.unsure.size() > most_parts) return {{}, {target}};
    if (sight.seen.empty() && sight.unsure.empty()) break;
  }
  return sight;
}

bool wall_hides(const Polygon& wall, const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  const Plane plane = plane_of(wall);
  std::vector<Vec3> points;
  if (!crossings(plane, a, b, points)) return false;
  return std::all_of(points.begin(), points.end(),
                     [&](const Vec3& p) { return contains(wall, plane.n, p); });
}

bool walls_hide(const Plane& plane, const std::vector<const Polygon*>& walls,
                const std::vector<Vec3>& a, const std::vector<Vec3>& b, double tolerance_m) {
  std::vector<Vec3> points;
  if (!crossings(plane, a, b, points)) return false;
  std::vector<Polygon> open{convex_hull(points, plane.n)};
  if (open.front().size() < 3) return false;
  for (const Polygon* wall : walls) {
    std::vector<Polygon> left;
    for (const Polygon& part : open) {
      for (Polygon& rest : subtract_coplanar(part, *wall, tolerance_m))
        left.push_back(std::move(rest));
    }
    open = std::move(left);
    if (open.empty()) return true;
    if (open.size() > 64) return false;
  }
  return false;
}

}  // namespace enfilade
