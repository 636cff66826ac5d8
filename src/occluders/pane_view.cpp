#include "occluders/pane_view.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/clip.hpp"
#include "geometry/form_factor.hpp"

namespace enfilade {
namespace {

/// What passes may vary by this share within a part: the rule of three points is exact for what
/// varies as a square, so that its mean is right to a small part of that.
constexpr double most_passage_variation = 0.05;
constexpr int most_pane_halvings = 7;
/// A part with a smaller form factor is not halved.
constexpr double least_pane_factor = 1e-7;

/// The half spaces that a pane's shadow fills, as x casts it; none where x lies in its plane.
std::vector<Plane> shadow_of(const Vec3& x, const Polygon& pane, double tolerance_m) {
  std::vector<Plane> planes;
  const Vec3 m = normal(pane);
  const double side = glm::dot(m, x - pane[0]);
  if (std::abs(side) <= tolerance_m) return planes;
  const double sign = side > 0.0 ? -1.0 : 1.0;
  planes.push_back({sign * m, glm::dot(sign * m, pane[0])});
  for (std::size_t i = 0; i < pane.size(); ++i) {
    const Vec3 c = glm::cross(pane[i] - x, pane[(i + 1) % pane.size()] - x);
    const double l = glm::length(c);
    if (l > 0.0) planes.push_back({sign / l * c, glm::dot(sign / l * c, x)});
  }
  return planes;
}

struct Seen {
  Polygon polygon;
  std::vector<std::uint32_t> panes;  ///< that it is seen through
};

void cut_by_one(const std::vector<Plane>& shadow, std::uint32_t pane, double tolerance_m,
                std::vector<Seen>& parts) {
  std::vector<Seen> next;
  for (Seen& part : parts) {
    Polygon inside = part.polygon;
    std::vector<Polygon> outside;
    for (const Plane& plane : shadow) {
      auto [front, behind] = split(inside, plane, tolerance_m);
      inside = std::move(front);
      if (inside.size() < 3) break;
      if (behind.size() >= 3) outside.push_back(std::move(behind));
    }
    if (inside.size() < 3) {
      next.push_back(std::move(part));
      continue;
    }
    for (Polygon& rest : outside) next.push_back({std::move(rest), part.panes});
    part.panes.push_back(pane);
    next.push_back({std::move(inside), std::move(part.panes)});
  }
  parts = std::move(next);
}

class Dimming {
 public:
  Dimming(const Vec3& x, const Vec3& n, const Occluders& occluders, double negligible,
          std::vector<DimmedPart>& parts)
      : x_(x), n_(n), occluders_(occluders), negligible_(negligible), parts_(parts) {}

  void add(const Polygon& polygon, std::span<const std::uint32_t> panes) {
    normals_.clear();
    for (const std::uint32_t pane : panes) normals_.push_back(normal(occluders_.polygon(pane)));
    add(polygon, panes, 0);
  }

 private:
  void add(const Polygon& polygon, std::span<const std::uint32_t> panes, int halvings) {
    const double factor = point_to_polygon(x_, n_, polygon);
    if (factor <= 0.0) return;
    if (panes.empty()) {
      parts_.push_back({polygon, factor, {}});
      return;
    }
    double least = 1.0, most = 0.0;
    for (const Vec3& corner : polygon) {
      const double share = passage(corner, panes).share;
      least = std::min(least, share);
      most = std::max(most, share);
    }
    if (most - least > most_passage_variation * most && (most - least) * factor > negligible_ &&
        halvings < most_pane_halvings && factor > least_pane_factor) {
      const auto [first, second] = halves(polygon);
      if (first.size() >= 3 && second.size() >= 3) {
        add(first, panes, halvings + 1);
        add(second, panes, halvings + 1);
        return;
      }
    }
    parts_.push_back({polygon, factor, mean(polygon, panes)});
  }

  Passage passage(const Vec3& y, std::span<const std::uint32_t> panes) const {
    Passage passed;
    const Vec3 d = glm::normalize(y - x_);
    for (std::size_t i = 0; i < panes.size(); ++i)
      occluders_.panes().dim(passed, panes[i], glm::dot(d, normals_[i]));
    return passed;
  }

  /// Three points a triangle (Strang and Fix 1973), weighed by the kernel to x.
  Passage mean(const Polygon& polygon, std::span<const std::uint32_t> panes) const {
    const Vec3 m = normal(polygon);
    Passage result;
    double sum = 0.0, weights = 0.0;
    for (std::size_t i = 2; i < polygon.size(); ++i) {
      const Vec3 corner[3] = {polygon[0], polygon[i - 1], polygon[i]};
      const double area = glm::length(glm::cross(corner[1] - corner[0], corner[2] - corner[0]));
      for (int side = 0; side < 3; ++side) {
        const Vec3 y = 0.5 * (corner[side] + corner[(side + 1) % 3]);
        const Passage here = passage(y, panes);
        const double weight = area * point_kernel(x_, n_, y, m);
        weights += weight;
        sum += weight * here.share;
        result.tint = here.tint;  // of the same panes: the same everywhere
      }
    }
    result.share = weights > 0.0 ? sum / weights : passage(centroid(polygon), panes).share;
    return result;
  }

  /// Across its longest edge.
  static std::pair<Polygon, Polygon> halves(const Polygon& polygon) {
    std::size_t longest = 0;
    const auto edge = [&](std::size_t i) { return polygon[(i + 1) % polygon.size()] - polygon[i]; };
    for (std::size_t i = 1; i < polygon.size(); ++i) {
      if (glm::length(edge(i)) > glm::length(edge(longest))) longest = i;
    }
    const Vec3 along = glm::normalize(edge(longest));
    return split(polygon, {along, glm::dot(along, centroid(polygon))}, 0.0);
  }

  const Vec3 x_, n_;
  const Occluders& occluders_;
  double negligible_;
  std::vector<DimmedPart>& parts_;
  std::vector<Vec3> normals_;  ///< of the panes
};

}  // namespace

void cut_by_panes(const Vec3& x, const Vec3& n, std::span<const Vec3> polygon,
                  std::span<const std::uint32_t> panes, const Occluders& occluders,
                  std::vector<DimmedPart>& parts, double negligible) {
  parts.clear();
  std::vector<Seen> seen{{Polygon(polygon.begin(), polygon.end()), {}}};
  for (const std::uint32_t pane : panes) {
    const double tolerance_m = occluders.tolerance_m();
    const std::vector<Plane> shadow = shadow_of(x, occluders.polygon(pane), tolerance_m);
    if (!shadow.empty()) cut_by_one(shadow, pane, tolerance_m, seen);
  }
  Dimming dimming(x, n, occluders, negligible, parts);
  for (const Seen& part : seen) dimming.add(part.polygon, part.panes);
}

double cut_by_panes(const Vec3& x, const Vec3& n, const VisibleParts& visible,
                    std::span<const std::uint32_t> panes, const Occluders& occluders,
                    std::vector<DimmedPart>& parts) {
  parts.clear();
  double seen = 0.0;
  std::vector<DimmedPart> of_one;
  for (std::size_t p = 0; p < visible.size(); ++p) {
    cut_by_panes(x, n, visible[p], panes, occluders, of_one);
    for (DimmedPart& part : of_one) {
      seen += part.factor * part.passage.share;
      parts.push_back(std::move(part));
    }
  }
  return seen;
}

bool only_whole_panes_between(const Polygon& a, std::uint32_t own, const Polygon& b,
                              const Occluders& occluders) {
  if (!occluders.panes().any()) return false;
  constexpr std::uint32_t none = RayScene::no_polygon;
  std::vector<std::uint32_t> panes, between;
  occluders.panes_between(a, b, own, none, panes);
  return std::ranges::all_of(
             panes, [&](std::uint32_t pane) { return occluders.shaft_shut(a, b, pane); }) &&
         occluders.find_between(a, b, own, none, 2 * panes.size(), between) && between.empty();
}

}  // namespace enfilade
