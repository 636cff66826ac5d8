#include "geometry/form_factor.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/clip.hpp"

namespace enfilade {
namespace {

/// One edge's term of Lambert's formula, without the 1/(2 pi).
double edge_term(const Vec3& a, const Vec3& b, const Vec3& n) {
  const Vec3 c = glm::cross(a, b);
  const double length = glm::length(c);
  if (length <= 0.0) return 0.0;
  return std::atan2(length, glm::dot(a, b)) * glm::dot(c, n) / length;
}

}  // namespace

double point_to_polygon(const Vec3& x, const Vec3& n, std::span<const Vec3> polygon) {
  // Zero where x is not in front of the polygon.
  if (glm::dot(area_vector(polygon), polygon[0] - x) >= 0.0) return 0.0;

  double sum = 0.0;
  // Walk the edges, clipping at the horizon: `kept` is the last vertex above it.
  Vec3 start(0.0), kept(0.0);
  bool any = false;
  auto visit = [&](const Vec3& v) {
    if (any) {
      sum += edge_term(kept, v, n);
    } else {
      start = v;
      any = true;
    }
    kept = v;
  };
  walk_cut(
      polygon.size(), [&](std::size_t i) { return polygon[i] - x; },
      [&](const Vec3& v) { return -glm::dot(v, n); },
      [&](const Vec3& v, bool is_above_horizon) {
        if (is_above_horizon) visit(v);
      },
      visit);
  if (!any) return 0.0;
  sum += edge_term(kept, start, n);
  // Seen from its front, a counter-clockwise polygon runs clockwise around n.
  return std::clamp(-sum / (2.0 * std::numbers::pi), 0.0, 1.0);
}

double rim_misfit(const FlatReceiver& receiver, std::span<const Vec3> shooter,
                  const std::array<double, 4>& at, std::uint64_t& evaluated,
                  const RimConfig& config) {
  const auto [least, most] = std::minmax_element(at.begin(), at.end());
  if (*most <= 0.0 || *most - *least > config.spread * *most) return 0.0;
  const Vec3 area = area_vector(shooter);
  const double gap_m = std::abs(glm::dot(area, receiver.center - shooter[0])) / glm::length(area);
  if (gap_m > config.gap * receiver.radius_m) return 0.0;
  double off = 0.0;
  for (const Vec3& corner : receiver.corners)
    off += std::abs(*most - point_to_polygon(corner, receiver.n, shooter));
  evaluated += receiver.corners.size();
  return std::min(config.most_area, config.area_per_gap * gap_m / receiver.radius_m) * off /
         static_cast<double>(receiver.corners.size());
}

double solid_angle(const Vec3& x, std::span<const Vec3> polygon) {
  double sum = 0.0;
  const Vec3 a = polygon[0] - x;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const Vec3 b = polygon[i - 1] - x, c = polygon[i] - x;
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    sum += 2.0 *
           std::atan2(glm::dot(a, glm::cross(b, c)), la * lb * lc + glm::dot(a, b) * lc +
                                                         glm::dot(b, c) * la + glm::dot(c, a) * lb);
  }
  return std::abs(sum);
}

double point_kernel(const Vec3& x, const Vec3& n, const Vec3& y, const Vec3& m) {
  const Vec3 d = y - x;
  const double r2 = glm::dot(d, d);
  const double cos_x = glm::dot(n, d);
  const double cos_y = -glm::dot(m, d);
  if (cos_x <= 0.0 || cos_y <= 0.0 || r2 <= 0.0) return 0.0;
  return cos_x * cos_y / (std::numbers::pi * r2 * r2);
}

}  // namespace enfilade
