#include "geometry/kernel_sample.hpp"

#include <algorithm>
#include <array>

#include "geometry/form_factor.hpp"
#include "geometry/polygon.hpp"
#include "geometry/sampling.hpp"

namespace enfilade {
namespace {

double square(const Vec3& d) { return glm::dot(d, d); }

using Triangle = std::array<Vec3, 3>;

/// Its longest edge runs from the first corner to the second.
Triangle longest_first(const Triangle& t) {
  const double edge[3] = {square(t[1] - t[0]), square(t[2] - t[1]), square(t[0] - t[2])};
  if (edge[0] >= edge[1] && edge[0] >= edge[2]) return t;
  return edge[1] >= edge[2] ? Triangle{t[1], t[2], t[0]} : Triangle{t[2], t[0], t[1]};
}

/// True where the closest corner is farther away than the square root of `far2` times the longest
/// distance of a corner from the first.
bool is_far(const Vec3& x, std::span<const Vec3> corners, double far2) {
  double nearest2 = square(corners[0] - x), size2 = 0.0;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    nearest2 = std::min(nearest2, square(corners[i] - x));
    size2 = std::max(size2, square(corners[i] - corners[0]));
  }
  return nearest2 > far2 * size2;
}

KernelSample weighted(const Vec3& x, const Vec3& n, std::span<const Vec3> polygon, const Vec3& at,
                      double per_density) {
  const Vec3 m = area_vector(polygon);
  return {at, per_density * point_kernel(x, n, at, glm::normalize(m))};
}

}  // namespace

KernelSample sample_by_kernel(const Vec3& x, const Vec3& n, std::span<const Vec3> polygon,
                              Random& random, const KernelSampleConfig& config) {
  const double r1 = random.uniform(), r2 = random.uniform();
  if (is_far(x, polygon, config.far2)) {
    const Polygon whole(polygon.begin(), polygon.end());
    return weighted(x, n, polygon, uniform_point(whole, r1, r2), area_m2(whole));
  }
  const double all = point_to_polygon(x, n, polygon);
  if (all <= 0.0) return {};
  // The fan's triangle.
  double pick = random.uniform() * all, factor = 0.0;
  Triangle part{polygon[0], polygon[1], polygon[2]};
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const Triangle next{polygon[0], polygon[i - 1], polygon[i]};
    const double share = point_to_polygon(x, n, next);
    if (share <= 0.0) continue;
    part = next;
    factor = share;
    if (pick < share) break;
    pick -= share;
  }
  if (factor <= 0.0) return {};
  double chance = factor / all;
  for (int i = 0; i < config.most_halvings && !is_far(x, part, config.far2); ++i) {
    part = longest_first(part);
    const Vec3 middle = 0.5 * (part[0] + part[1]);
    const Triangle left{part[0], middle, part[2]}, right{middle, part[1], part[2]};
    const double of_left = std::min(point_to_polygon(x, n, left), factor);
    const bool goes_left = random.uniform() * factor < of_left;
    const double next = goes_left ? of_left : factor - of_left;
    chance *= next / factor;
    factor = next;
    part = goes_left ? left : right;
    if (factor <= 0.0) return {};
  }
  const double m2 = 0.5 * glm::length(glm::cross(part[1] - part[0], part[2] - part[0]));
  return weighted(x, n, polygon, point_in_triangle(part[0], part[1], part[2], r1, r2), m2 / chance);
}

}  // namespace enfilade
