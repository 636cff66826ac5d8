#include "view_factors/row_source.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>

#include "final_gather/point_place.hpp"
#include "geometry/form_factor.hpp"
#include "geometry/sampling.hpp"

namespace enfilade {
namespace {

/// Parts of a polygon behind many others are sampled below this factor.
constexpr double sampled_factor = 1e-3;
/// Radiosity does not matter: parts are as large as their visibility allows.
constexpr double any_variation = 1e30;

/// A point that sees less than this of fronts sees none.
constexpr double sees_nothing = 1e-6;

/// True where a body stands on the polygon: its inside is what the point sees.
bool is_covered(const Occluders& occluders, const Vec3& p, const Vec3& n, std::uint32_t own) {
  const RayHit hit = occluders.rays().closest(p, n, own);
  return hit.any() && !hit.front;
}

std::array<Polygon, 4> quarters(const Polygon& t) {
  const Vec3 a = 0.5 * (t[0] + t[1]), b = 0.5 * (t[1] + t[2]), c = 0.5 * (t[2] + t[0]);
  return {Polygon{t[0], a, c}, Polygon{a, t[1], b}, Polygon{c, b, t[2]}, Polygon{a, b, c}};
}

}  // namespace

void RowSum::add(const RowSum& other) {
  for (std::size_t i = 0; i < factor_m2.size(); ++i) {
    factor_m2[i] += other.factor_m2[i];
    error_m2[i] += other.error_m2[i];
  }
  covered_m2 += other.covered_m2;
}

/// A triangle, and the integral of the row over it by three points.
struct RowSource::Part {
  Polygon triangle;
  std::vector<double> integral;  ///< m2, by group
  double covered_m2 = 0.0;
};

RowSource::RowSource(std::span<const ClusterState> states, const Occluders& occluders,
                     const ViewFactorGroups& groups, const ViewFactorConfig& config)
    : states_(states),
      occluders_(occluders),
      groups_(groups),
      config_(config),
      visible_(occluders) {}

std::vector<double> RowSource::row_at(const Vec3& p, const Vec3& n, std::uint32_t own,
                                      Random& random) {
  std::vector<double> row(groups_.names.size(), 0.0);
  VisibleNode node;
  for (const ClusterState& state : states_) {
    const PatchForest& forest = state.patches();
    for (std::uint32_t k = 0; k < forest.polygons(); ++k) {
      const std::uint32_t number = occluders_.global(state.id(), k);
      const std::uint32_t group = groups_.of_polygon[number];
      if (group == ViewFactorGroups::none || number == own) continue;
      if (!(point_to_polygon(p, n, occluders_.polygon(number)) > 0.0)) continue;
      visible_.find_by_parts(p, n, own, state.id(), forest, k, any_variation, sampled_factor,
                             random, node);
      row[group] += node.factor;
    }
  }
  return row;
}

/// Three points integrate quadratics over a triangle (Strang and Fix 1973).
RowSource::Part RowSource::part_of(const Polygon& triangle, std::uint32_t own, Random& random) {
  Part part{triangle, std::vector<double>(groups_.names.size(), 0.0), 0.0};
  const double third_m2 = area_m2(triangle) / 3.0;
  const Vec3 n = normal(occluders_.polygon(own));
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 p = 2.0 / 3.0 * triangle[i] + 1.0 / 6.0 * triangle[(i + 1) % 3] +
                   1.0 / 6.0 * triangle[(i + 2) % 3];
    const std::vector<double> row = row_at(lifted(occluders_, p, n), n, own, random);
    double sum = 0.0;
    for (std::size_t k = 0; k < row.size(); ++k) {
      part.integral[k] += third_m2 * row[k];
      sum += row[k];
    }
    if (sum < sees_nothing && is_covered(occluders_, p, n, own)) part.covered_m2 += third_m2;
  }
  return part;
}

RowSum RowSource::by_quadrature(std::uint32_t own) {
  Random random(config_.seed + own);
  const std::size_t groups = groups_.names.size();
  const Polygon& polygon = occluders_.polygon(own);
  const double allowed_m2 = config_.error * area_m2(polygon);
  /// Four quarters that stand for their whole, and what they differ from it by.
  struct Refined {
    double error_m2 = 0.0;
    std::array<Part, 4> parts;
    RowSum sum;
    bool operator<(const Refined& other) const { return error_m2 < other.error_m2; }
  };
  int points = 0;
  const auto refine = [&](const Part& whole) {
    Refined refined{0.0, {}, RowSum(groups)};
    const std::array<Polygon, 4> triangles = quarters(whole.triangle);
    for (std::size_t i = 0; i < 4; ++i) {
      refined.parts[i] = part_of(triangles[i], own, random);
      refined.sum.covered_m2 += refined.parts[i].covered_m2;
      for (std::size_t k = 0; k < groups; ++k)
        refined.sum.factor_m2[k] += refined.parts[i].integral[k];
    }
    for (std::size_t k = 0; k < groups; ++k) {
      // The quarters' own error is less than the difference by two to four times.
      refined.sum.error_m2[k] = 0.5 * std::abs(refined.sum.factor_m2[k] - whole.integral[k]);
      refined.error_m2 += refined.sum.error_m2[k];
    }
    points += 12;
    return refined;
  };
  std::priority_queue<Refined> queue;
  double error_m2 = 0.0;
  const auto push = [&](Refined refined) {
    error_m2 += refined.error_m2;
    queue.push(std::move(refined));
  };
  for (std::size_t i = 2; i < polygon.size(); ++i)
    push(refine(part_of({polygon[0], polygon[i - 1], polygon[i]}, own, random)));
  while (error_m2 > allowed_m2 && points < config_.most_points) {
    const Refined worst = queue.top();
    queue.pop();
    error_m2 -= worst.error_m2;
    for (const Part& part : worst.parts) push(refine(part));
  }
  RowSum sum(groups);
  for (; !queue.empty(); queue.pop()) sum.add(queue.top().sum);
  return sum;
}

RowSum RowSource::by_rays(std::uint32_t own, int rays) {
  Random random(config_.seed + own);
  RowSum sum(groups_.names.size());
  const Polygon& polygon = occluders_.polygon(own);
  const Vec3 n = normal(polygon);
  const double each_m2 = area_m2(polygon) / rays;
  for (int i = 0; i < rays; ++i) {
    const Vec3 from = uniform_point(polygon, (i + random.uniform()) / rays, random.uniform()) +
                      2.0 * occluders_.rays().epsilon_m() * n;
    const double r2 = random.uniform(), turn = random.uniform();
    const RayHit hit =
        occluders_.rays().closest(from, cosine_direction(n, r2, turn), own, 1e30, RayStart::in_air);
    if (!hit.any() || !hit.front) continue;
    const std::uint32_t group = groups_.of_polygon[hit.polygon];
    if (group != ViewFactorGroups::none) sum.factor_m2[group] += each_m2;
  }
  // The standard deviation of a count.
  for (std::size_t k = 0; k < sum.factor_m2.size(); ++k) {
    const double share = std::min(1.0, sum.factor_m2[k] / (each_m2 * rays));
    sum.error_m2[k] = each_m2 * std::sqrt(rays * share * (1.0 - share));
  }
  return sum;
}

}  // namespace enfilade
