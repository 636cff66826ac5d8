// Cutting a line space down by the penumbrae of its windows, and crossing it with planes.
#include "visibility/line_space.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/sampling.hpp"
#include "visibility/facing.hpp"

namespace enfilade {
namespace {

// Points whose hull is the part of the points' hull in front of the plane (`sign` 1) or behind it
// (-1).
std::vector<Vec3> clip_points(const std::vector<Vec3>& points, const Plane& plane, double sign) {
  const auto in_front = [&](const Vec3& p) { return sign * plane.signed_distance(p) >= 0.0; };
  if (std::all_of(points.begin(), points.end(), in_front)) return points;
  std::vector<Vec3> kept;
  for (const Vec3& p : points) {
    const double dp = sign * plane.signed_distance(p);
    if (dp >= 0.0) kept.push_back(p);
    if (dp <= 0.0) continue;
    for (const Vec3& q : points) {
      const double dq = sign * plane.signed_distance(q);
      if (dq < 0.0) kept.push_back(zero_crossing(p, dp, q, dq));
    }
  }
  return kept;
}

bool is_within(const Polygon& polygon, const HalfSpaces& spaces, double slack_m) {
  return std::all_of(spaces.begin(), spaces.end(), [&](const Plane& plane) {
    return std::all_of(polygon.begin(), polygon.end(),
                       [&](const Vec3& p) { return plane.signed_distance(p) >= -slack_m; });
  });
}

// Cuts the parts of a side to the half spaces; false where no part is left.
bool cut_side(LineSpaceSide& side, const HalfSpaces& spaces, double slack_m) {
  std::vector<LineSpacePart> kept;
  bool cut = false;
  for (LineSpacePart& part : side.parts) {
    if (is_within(part.polygon(), spaces, slack_m)) {
      kept.push_back(std::move(part));
      continue;
    }
    cut = true;
    if (outside(part.polygon(), spaces, slack_m)) continue;
    Polygon polygon = clip_to(part.polygon(), spaces, slack_m);
    // A remainder no wider than the slack only touches the border.
    if (polygon.size() < 3 || area_m2(polygon) <= 4.0 * slack_m * diameter(polygon)) continue;
    kept.push_back(part.cut_to(std::move(polygon)));
  }
  if (cut) {
    side = side_of(std::move(kept));
  } else {
    side.parts = std::move(kept);
  }
  return !side.parts.empty();
}

// Half spaces that lines from these points through the window stay in beyond it.
HalfSpaces penumbra(const std::vector<Vec3>& points, const Window& window, double direction,
                    double slack_m) {
  HalfSpaces spaces;
  const Vec3 n = direction * window.n;
  const Plane plane{n, glm::dot(n, window.polygon[0])};
  const std::vector<Vec3> near = clip_points(points, plane, -1.0);
  if (!near.empty()) add_penumbra(near, window.polygon, n, slack_m, spaces);
  spaces.push_back({n, plane.d - slack_m});
  return spaces;
}

// On which side of the plane the side lies: 1 in front, -1 behind, 0 on both or in it.
int where(const LineSpaceSide& side, const Plane& plane, double tolerance_m) {
  double lowest = 0.0, highest = 0.0;
  bool flat_front = false, flat_back = false;
  for (const LineSpacePart& part : side.parts) {
    const auto [low, high, sum] = distances(part.polygon(), plane);
    lowest = std::min(lowest, low);
    highest = std::max(highest, high);
    // A polygon that lies in the plane is on the side that it faces: nothing in the plane hides
    // that.
    const double facing = glm::dot(part.plane().n, plane.n);
    if (std::max(high, -low) > 2.0 * tolerance_m || std::abs(facing) < 0.5) continue;
    (facing < 0.0 ? flat_front : flat_back) = true;
  }
  const double flat_m = rounding_m(tolerance_m);
  if (lowest >= -flat_m && !flat_front) return 1;
  return highest <= flat_m && !flat_back ? -1 : 0;
}

int where(const Window& window, const Plane& plane, double tolerance_m) {
  const auto [lowest, highest, sum] = distances(window.polygon, plane);
  const double flat_m = rounding_m(tolerance_m);
  if (lowest >= -flat_m && highest > 2.0 * tolerance_m) return 1;
  return highest <= flat_m && lowest < -2.0 * tolerance_m ? -1 : 0;
}

// The hull of where segments from one set of points to the other cross the plane between them.
Polygon crossings(const std::vector<Vec3>& from, const std::vector<Vec3>& to, const Plane& plane,
                  double sign, double tolerance_m) {
  const std::vector<Vec3> on_a = clip_points(from, plane, sign);
  const std::vector<Vec3> on_b = clip_points(to, plane, -sign);
  std::vector<Vec3> points;
  points.reserve(on_a.size() * on_b.size());
  for (const Vec3& p : on_a) {
    const double dp = std::abs(plane.signed_distance(p));
    for (const Vec3& q : on_b) {
      const double sum = dp + std::abs(plane.signed_distance(q));
      points.push_back(sum > 0.0 ? p + dp / sum * (q - p) : p);
      if (sum <= 0.0) points.push_back(q);
    }
  }
  Polygon region = convex_hull(std::move(points), plane.n);
  if (region.size() < 3 || area_m2(region) <= rounding_m(tolerance_m) * diameter(region)) return {};
  return region;
}

}  // namespace

bool drop_averted(LineSpace& lines, double flat_m) {
  LineSpaceSide &a = lines.a, &b = lines.b;
  for (int pass = 0; pass < 2; ++pass) {  // the first pass may make sides smaller
    for (const auto& sides : {std::pair{&a, &b}, std::pair{&b, &a}}) {
      LineSpaceSide* const side = sides.first;
      const LineSpaceSide* const other = sides.second;
      const std::size_t before = side->parts.size();
      std::erase_if(side->parts, [&](const LineSpacePart& part) {
        return !any_in_front(other->box, part.plane(), flat_m) ||
               std::none_of(other->parts.begin(), other->parts.end(), [&](const LineSpacePart& o) {
                 return any_in_front(o.polygon(), part.plane(), flat_m);
               });
      });
      if (side->parts.empty()) return false;
      if (side->parts.size() < before) *side = side_of(std::move(side->parts));
    }
  }
  if (a.parts.size() > 1 || b.parts.size() > 1) return true;
  // One polygon against one: only the part in front of the other exchanges light.
  for (auto [side, other] : {std::pair{&a, &b}, std::pair{&b, &a}}) {
    const LineSpacePart part = side->parts[0];
    const Plane& plane = other->parts[0].plane();
    if (std::all_of(part.polygon().begin(), part.polygon().end(),
                    [&](const Vec3& p) { return plane.signed_distance(p) >= flat_m; })) {
      continue;
    }
    Polygon polygon = part.polygon();
    clip_front(polygon, {plane.n, plane.d + flat_m}, 0.0);
    if (polygon.size() < 3) return false;
    *side = side_of({part.cut_to(std::move(polygon))});
  }
  return true;
}

bool tighten(LineSpace& lines, double slack_m) {
  const std::size_t windows = lines.windows.size();
  lines.beyond.assign(windows, {});
  lines.before.assign(windows, {});
  for (std::size_t i = 0; i < windows; ++i) {
    Polygon& polygon = lines.windows[i].polygon;
    for (std::size_t j = 0; j < i && !polygon.empty(); ++j) {
      polygon = clip_to(std::move(polygon), lines.beyond[j], slack_m);
    }
    if (polygon.size() < 3) return false;
    lines.beyond[i] = penumbra(lines.a.points, lines.windows[i], 1.0, slack_m);
  }
  for (std::size_t i = windows; i-- > 0;) {
    if (!cut_side(lines.b, lines.beyond[i], slack_m)) return false;
  }
  for (std::size_t i = windows; i-- > 0;) {
    Polygon& polygon = lines.windows[i].polygon;
    for (std::size_t j = i + 1; j < windows && !polygon.empty(); ++j) {
      polygon = clip_to(std::move(polygon), lines.before[j], slack_m);
    }
    if (polygon.size() < 3) return false;
    lines.before[i] = penumbra(lines.b.points, lines.windows[i], -1.0, slack_m);
  }
  for (std::size_t i = 0; i < windows; ++i) {
    if (!cut_side(lines.a, lines.before[i], slack_m)) return false;
  }
  return true;
}

std::optional<LineSpaceCrossing> crossing(const LineSpace& lines, const Plane& plane,
                                          double tolerance_m) {
  const std::size_t windows = lines.windows.size();
  const auto side_of_stop = [&](std::size_t stop) {
    if (stop == 0) return where(lines.a, plane, tolerance_m);
    if (stop > windows) return where(lines.b, plane, tolerance_m);
    return where(lines.windows[stop - 1], plane, tolerance_m);
  };
  const auto points_of = [&](std::size_t stop) -> const std::vector<Vec3>& {
    if (stop == 0) return lines.a.points;
    return stop > windows ? lines.b.points : lines.windows[stop - 1].polygon;
  };
  std::size_t last_stop = 0;
  int last = 0;
  for (std::size_t stop = 0; stop <= windows + 1; ++stop) {
    const int here = side_of_stop(stop);
    if (here == 0) {
      if (stop == 0) return {};
      continue;
    }
    if (last * here < 0) {
      LineSpaceCrossing found{
          last_stop, stop - 1,
          crossings(points_of(last_stop), points_of(stop), plane, last, tolerance_m)};
      const double slack_m = rounding_m(tolerance_m);
      for (std::size_t i = 0; i < windows && !found.region.empty(); ++i) {
        if (i >= found.first && i < found.end) continue;
        found.region = clip_to(std::move(found.region),
                               i < found.first ? lines.beyond[i] : lines.before[i], slack_m);
      }
      return found;
    }
    last = here;
    last_stop = stop;
  }
  return {};
}

}  // namespace enfilade
