// Lines through a random point of a random window, or between two random points of the sides.
#include "visibility/line_sampling.hpp"

#include "geometry/sampling.hpp"

namespace enfilade {
namespace {

// A random point of the polygon. For a triangle no number is drawn to choose one of the fan.
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

// The line from a random point of one side through point w of a window to the other side; none
// where it misses a window or the other side.
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

}  // namespace

std::optional<SampledLine> draw_line(const LineSpace& lines, Random& random) {
  constexpr int tries = 4;  // most lines miss where the windows are out of line
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
