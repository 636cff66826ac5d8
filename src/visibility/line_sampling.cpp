// Lines through a random point of a random window, or between two random points of the sides.
#include "visibility/line_sampling.hpp"

#include <cmath>

namespace enfilade {
namespace {

bool inside(const Polygon& polygon, const Vec3& n, const Vec3& p) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    if (glm::dot(glm::cross(n, edge), p - polygon[i]) < 0.0) return false;
  }
  return true;
}

Vec3 random_point(const Polygon& p, Random& random) {
  const std::size_t k = p.size() <= 3 ? 1 : 1 + random.below(p.size() - 2);
  const double s = std::sqrt(random.uniform()), t = random.uniform();
  return (1.0 - s) * p[0] + s * ((1.0 - t) * p[k] + t * p[k + 1]);
}

bool passes(const Window& window, const Vec3& p, const Vec3& d) {
  const double along = glm::dot(window.n, d);
  if (along == 0.0) return false;
  const Vec3 hit = p + glm::dot(window.n, window.polygon[0] - p) / along * d;
  const Vec3 n = normal(window.polygon);
  return inside(window.polygon, n, hit);
}

// The line from a random point of one side through point w of a window to the other side; none
// where it misses a window or the other side.
std::optional<SampledLine> line_through(const LineSpace& lines, bool from_a, const Vec3& w,
                                        Random& random) {
  const LineSpaceSide &near = from_a ? lines.a : lines.b, &far = from_a ? lines.b : lines.a;
  const LineSpacePart& start = near.parts[random.below(near.parts.size())];
  const Vec3 p = random_point(start.polygon(), random);
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
    if (t <= 1.0 || !inside(part.polygon(), plane.n, p + t * d)) continue;
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
    const Vec3 w = random_point(window.polygon, random);
    if (auto line = line_through(lines, random.below(2) == 0, w, random)) return line;
  }
  return {};
}

std::optional<SampledLine> draw_any_line(const LineSpace& lines, Random& random) {
  const LineSpacePart& from = lines.a.parts[random.below(lines.a.parts.size())];
  const LineSpacePart& to = lines.b.parts[random.below(lines.b.parts.size())];
  const Vec3 p = random_point(from.polygon(), random);
  const Vec3 q = random_point(to.polygon(), random);
  if (from.plane().signed_distance(q) <= 0.0 || to.plane().signed_distance(p) <= 0.0) {
    return {};
  }
  return SampledLine{&from, &to, p, q};
}

}  // namespace enfilade
