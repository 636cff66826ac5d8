#include "visibility/line_space.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/sampling.hpp"
#include "visibility/facing.hpp"

namespace enfilade {
namespace {

constexpr std::size_t most_points = 12;  // of a side; more are replaced by the corners of its box

void add_distinct(std::vector<Vec3>& points, const Polygon& polygon) {
  for (const Vec3& p : polygon) {
    if (std::find(points.begin(), points.end(), p) == points.end()) points.push_back(p);
  }
}

struct Corners {
  std::vector<Vec3> points;
  double volume_m3 = 0.0;
};

// Of the smallest box along the axes that holds all parts.
Corners corners(const std::vector<LineSpacePart>& parts, const std::array<Vec3, 3>& axes) {
  Box box;
  for (const LineSpacePart& part : parts) box.add(bounds_along(part.polygon(), axes));
  Corners found;
  for (const Vec3& c : box.corners()) {
    found.points.push_back(c.x * axes[0] + c.y * axes[1] + c.z * axes[2]);
  }
  const Vec3 e = box.extent();
  found.volume_m3 = e.x * e.y * e.z;
  return found;
}

// A frame that follows the largest of the parts: rooms and furniture stand at any angle.
std::array<Vec3, 3> frame_of(const std::vector<LineSpacePart>& parts) {
  const auto area = [](const LineSpacePart& part) { return area_m2(part.polygon()); };
  const auto largest = std::max_element(
      parts.begin(), parts.end(),
      [&](const LineSpacePart& a, const LineSpacePart& b) { return area(a) < area(b); });
  const Polygon& polygon = largest->polygon();
  Vec3 along(0.0);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    if (glm::dot(edge, edge) > glm::dot(along, along)) along = edge;
  }
  const Vec3& n = largest->plane().n;
  along = glm::normalize(along - glm::dot(along, n) * n);
  return {n, along, glm::cross(n, along)};
}

std::vector<Vec3> corners(const std::vector<LineSpacePart>& parts) {
  Corners straight = corners(parts, {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)});
  Corners turned = corners(parts, frame_of(parts));
  // A frame of a sliver is no frame.
  return turned.volume_m3 < straight.volume_m3 ? turned.points : straight.points;
}

// The part of the points' hull in front of the plane (d >= 0), as points; `sign` -1 for behind.
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
    // What only the slack has left touches the border, no more.
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

// What lines from these points through the window stay in beyond it.
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

// Of a triangle no number is drawn for which triangle of the fan it is.
Vec3 point_on(const Polygon& p, Random& random) {
  if (p.size() > 3) return random_point(p, random);
  const double r1 = random.uniform(), r2 = random.uniform();
  return point_in_triangle(p[0], p[1], p[2], r1, r2);
}

bool passes(const Window& window, const Vec3& p, const Vec3& d) {
  const double along = glm::dot(window.n, d);
  if (along == 0.0) return false;
  const Vec3 hit = p + glm::dot(window.n, window.polygon[0] - p) / along * d;
  const Vec3 n = normal(window.polygon);
  return contains_within(window.polygon, n, hit, 0.0);
}

// From a point of the side on, through point w of a window, to the other side.
std::optional<SampledLine> line_through(const LineSpace& lines, bool from_a, const Vec3& w,
                                        Random& random) {
  const LineSpaceSide &near = from_a ? lines.a : lines.b, &far = from_a ? lines.b : lines.a;
  const LineSpacePart& start = near.parts[random.below(near.parts.size())];
  const Vec3 p = point_on(start.polygon(), random);
  const Vec3 d = w - p;
  if (glm::dot(start.plane().n, d) <= 0.0) return {};
  for (const Window& window : lines.windows) {
    if (!passes(window, p, d)) return {};
  }
  for (const LineSpacePart& part : far.parts) {
    const Plane& plane = part.plane();
    const double along = glm::dot(plane.n, d);
    if (along >= 0.0) continue;
    const double t = -plane.signed_distance(p) / along;
    if (t <= 1.0 || !contains_within(part.polygon(), plane.n, p + t * d, 0.0)) continue;
    const Vec3 q = p + t * d;
    return from_a ? SampledLine{&start, &part, p, q} : SampledLine{&part, &start, q, p};
  }
  return {};
}

// On which side of the plane the side lies: 1 in front, -1 behind, 0 on both or in it.
int where(const LineSpaceSide& side, const Plane& plane, double tolerance_m) {
  double lowest = 0.0, highest = 0.0;
  bool flat_front = false, flat_back = false;
  for (const LineSpacePart& part : side.parts) {
    const auto [low, high, sum] = distances(part.polygon(), plane);
    lowest = std::min(lowest, low);
    highest = std::max(highest, high);
    // A polygon in the plane itself: nothing there hides what it looks at.
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

LineSpaceSide side_of(std::vector<LineSpacePart> parts) {
  LineSpaceSide side;
  for (const LineSpacePart& part : parts) {
    side.box.add(bounds(part.polygon()));
    if (side.points.size() <= most_points) add_distinct(side.points, part.polygon());
  }
  if (side.points.size() > most_points) side.points = corners(parts);
  side.parts = std::move(parts);
  return side;
}

bool drop_averted(LineSpace& lines, double flat_m) {
  LineSpaceSide &a = lines.a, &b = lines.b;
  for (int pass = 0; pass < 2; ++pass) {
    for (auto [side, other] : {std::pair{&a, &b}, std::pair{&b, &a}}) {
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
  // One polygon against one: only what lies before the other takes part.
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

std::optional<SampledLine> draw_line(const LineSpace& lines, Random& random) {
  constexpr int tries = 4;
  for (int k = 0; k < tries; ++k) {
    if (lines.windows.empty()) {
      if (auto line = draw_any_line(lines, random)) return line;
      continue;
    }
    const Window& window = lines.windows[random.below(lines.windows.size())];
    const Vec3 w = point_on(window.polygon, random);
    if (auto line = line_through(lines, random.below(2) == 0, w, random)) return line;
  }
  return {};
}

std::optional<SampledLine> draw_any_line(const LineSpace& lines, Random& random) {
  const LineSpacePart& from = lines.a.parts[random.below(lines.a.parts.size())];
  const LineSpacePart& to = lines.b.parts[random.below(lines.b.parts.size())];
  const Vec3 p = point_on(from.polygon(), random);
  const Vec3 q = point_on(to.polygon(), random);
  if (from.plane().signed_distance(q) <= 0.0 || to.plane().signed_distance(p) <= 0.0) {
    return {};
  }
  return SampledLine{&from, &to, p, q};
}

}  // namespace enfilade
